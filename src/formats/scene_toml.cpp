// The only file that sees toml++, which is heavy to compile.
#include "mane/error.h"
#include "mane/scene.h"

#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>

namespace mane {
namespace {

Literal to_literal(const toml::node& node, const std::string& where) {
    if (const auto* b = node.as_boolean())
        return {b->get()};
    if (const auto* i = node.as_integer())
        return {i->get()};
    if (const auto* x = node.as_floating_point())
        return {x->get()};
    if (const auto* s = node.as_string())
        return {s->get()};
    const toml::array* array = node.as_array();
    if (!array)
        throw InputError(where + ": found a table or a date, expected a value");
    std::vector<Literal> items;
    for (const toml::node& item : *array)
        items.push_back(to_literal(item, where));
    return {std::move(items)};
}

std::string section_names() {
    std::string names = "override";
    std::string_view section;
    for (const FieldInfo* f : all_fields())
        if (f->section != section) {
            section = f->section;
            names += ", " + std::string(section);
        }
    return names;
}

std::string similar_section(const std::string& name) {
    std::vector<std::string> known{"override"};
    for (const FieldInfo* f : all_fields())
        known.emplace_back(f->section);
    const std::string nearest = nearest_name(name, known);
    return nearest.empty() ? " (known: " + section_names() + ")"
                           : " (did you mean [" + nearest + "]?)";
}

/// Reads one document. Messages start with `name` and the line.
class SceneReader {
  public:
    SceneReader(std::string name, std::filesystem::path folder)
        : name_(std::move(name)), folder_(std::move(folder)) {}

    SceneDesc read(const toml::table& document) const {
        SceneDesc scene;
        for (const auto& [key, node] : document) {
            if (key == "override")
                read_list("override", node, [&](const toml::table& t) { read_override(scene, t); });
            else if (key == "obstacle")
                read_list("obstacle", node, [&](const toml::table& t) { read_obstacle(scene, t); });
            else
                read_section(key, node, [&](const Field& f, const Value& v) { f.set(scene, v); });
        }
        check_scene(scene, name_);
        return scene;
    }

  private:
    std::string at(const toml::source_region& source) const {
        return name_ + ":" + std::to_string(source.begin.line);
    }

    /// Calls `set(field, value)` for each key of a `[section]` of the scene.
    template <typename Set>
    void read_section(const toml::key& key, const toml::node& node, const Set& set) const {
        const std::string section(key.str());
        const auto fields = fields_of<SceneDesc>();
        if (std::none_of(fields.begin(),
                         fields.end(), // not std::ranges: WebAssembly's library has none
                         [&](const Field& f) { return f.section == section; }))
            throw InputError(at(key.source()) + ": unknown section [" + section + "]" +
                             similar_section(section));
        const toml::table* table = node.as_table();
        if (!table)
            throw InputError(at(key.source()) + ": found a value, expected the section [" +
                             section + "]");
        for (const auto& [name, value] : *table)
            read_field<SceneDesc>(section, name, value, set);
    }

    template <typename Root, typename Set>
    void read_field(const std::string& section, const toml::key& name, const toml::node& node,
                    const Set& set) const {
        const std::string where = at(name.source());
        const FieldOf<Root>* field = find_field<Root>(section, name.str());
        if (!field)
            throw InputError(where + ": unknown key " + section + "." + std::string(name.str()) +
                             suggestion(section, name.str()));
        Value value = interpret(*field, to_literal(node, where), where);
        if (has(field->use, FieldUse::path))
            value = resolved(std::get<std::string>(value));
        set(*field, value);
    }

    std::string resolved(const std::string& file) const {
        return file.empty() ? file : (folder_ / file).lexically_normal().generic_string();
    }

    /// Calls `read` for each table of a `[[list]]`.
    template <typename Read>
    void read_list(const std::string& name, const toml::node& node, const Read& read) const {
        const toml::array* array = node.as_array();
        if (!array || !array->is_homogeneous<toml::table>())
            throw InputError(at(node.source()) + ": expected [[" + name + "]] with two brackets");
        for (const toml::node& item : *array)
            read(*item.as_table());
    }

    void read_obstacle(SceneDesc& scene, const toml::table& table) const {
        ObstacleDesc obstacle;
        const auto set = [](auto& into) {
            return [&](const auto& f, const Value& v) { f.set(into, v); };
        };
        const auto read_key = [&](const toml::table& t) {
            ObstacleKeyDesc place;
            for (const auto& [key, node] : t)
                read_field<ObstacleKeyDesc>("obstacle.key", key, node, set(place));
            obstacle.keys.push_back(place);
        };
        for (const auto& [key, node] : table) {
            if (key == "key")
                read_list("obstacle.key", node, read_key);
            else
                read_field<ObstacleDesc>("obstacle", key, node, set(obstacle));
        }
        scene.obstacles.push_back(std::move(obstacle));
    }

    void read_override(SceneDesc& scene, const toml::table& table) const {
        WispOverride result;
        for (const auto& [key, node] : table) {
            if (key == "wisps" && node.is_array()) {
                result.wisps = read_wisps(*node.as_array());
                continue;
            }
            read_section(key, node, [&, &key = key](const Field& field, const Value& value) {
                if (!has(field.use, FieldUse::per_wisp))
                    throw InputError(at(key.source()) + ": " + field.key() +
                                     " is one for all wisps, no [[override]] can set it");
                result.settings.emplace_back(field.key(), value);
            });
        }
        if (result.wisps.empty())
            throw InputError(at(table.source()) + ": [[override]] without wisps = [numbers]");
        scene.overrides.push_back(std::move(result));
    }

    std::vector<std::uint32_t> read_wisps(const toml::array& array) const {
        std::vector<std::uint32_t> wisps;
        for (const toml::node& item : array) {
            const std::optional<std::int64_t> wisp = item.value_exact<std::int64_t>();
            if (!wisp || *wisp < 0 || *wisp > 0xffffffff)
                throw InputError(at(item.source()) +
                                 ": override.wisps: expected a list of wisp numbers, from 0");
            wisps.push_back(static_cast<std::uint32_t>(*wisp));
        }
        return wisps;
    }

    std::string name_;
    std::filesystem::path folder_;
};

toml::table parse(std::string_view text, const std::string& name) {
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        throw InputError(name + ":" + std::to_string(error.source().begin.line) + ": " +
                         std::string(error.description()));
    }
}

} // namespace

SceneDesc parse_scene(std::string_view text, const std::string& name,
                      const std::filesystem::path& folder) {
    return SceneReader(name, folder).read(parse(text, name));
}

SceneDesc read_scene(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!in || std::filesystem::is_directory(file))
        throw InputError(file.string() + ": cannot be read");
    return parse_scene(text, file.string(), file.parent_path());
}

void apply_setting(SceneDesc& scene, std::string_view setting) {
    const std::string where = "--set " + std::string(setting);
    const std::size_t equals = setting.find('='), dot = setting.substr(0, equals).find('.');
    if (equals == std::string_view::npos || dot == std::string_view::npos)
        throw InputError(where + ": expected section.key=value");
    const std::string_view section = setting.substr(0, dot),
                           name = setting.substr(dot + 1, equals - dot - 1);
    const Field* field = find_field(section, name);
    if (!field)
        throw InputError(where + ": unknown key " + std::string(section) + "." + std::string(name) +
                         suggestion(section, name));

    const std::string value(setting.substr(equals + 1));
    Literal literal{value}; // a bare word, unless TOML knows better
    try {
        const toml::table table = toml::parse("value = " + value);
        if (table.size() == 1)
            literal = to_literal(*table.get("value"), where);
    } catch (const toml::parse_error&) {
    }
    field->set(scene, interpret(*field, literal, where));
    check_scene(scene, where);
}

} // namespace mane
