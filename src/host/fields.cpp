#include "base/parse_real.h"
#include "host/handle.h"

#include <cmath>
#include <cstring>

namespace mane {
namespace {

const Field& field_of(const char* key) {
    const std::string text = &given(key, "key");
    const std::size_t dot = text.find('.');
    const std::string section = text.substr(0, dot),
                      name = dot == std::string::npos ? "" : text.substr(dot + 1);
    if (const Field* field = find_field(section, name))
        return *field;
    throw InputError("no field " + text + suggestion(section, name));
}

Literal literal(const FieldInfo& field, double x) {
    if (std::holds_alternative<bool>(field.standard) && (x == 0 || x == 1))
        return {x == 1};
    if (x == std::floor(x) && std::fabs(x) < 9e15)
        return {static_cast<std::int64_t>(x)};
    return {x};
}

Literal literal(const FieldInfo& field, const double* numbers, std::size_t count) {
    given(numbers, "numbers");
    if (count == 1)
        return literal(field, *numbers);
    std::vector<Literal> list;
    for (std::size_t i = 0; i < count; ++i)
        list.push_back(literal(field, numbers[i]));
    return {list};
}

Literal literal(const FieldInfo& field, const char* text) {
    double x = 0;
    if (parse_real(text, x))
        return literal(field, x);
    if (std::holds_alternative<bool>(field.standard))
        for (const bool value : {false, true})
            if (std::strcmp(text, value ? "true" : "false") == 0)
                return {value};
    return {std::string(text)};
}

struct Numbers {
    std::vector<double> operator()(bool x) const { return {x ? 1.0 : 0.0}; }
    std::vector<double> operator()(std::uint32_t x) const { return {static_cast<double>(x)}; }
    std::vector<double> operator()(float x) const { return {double{x}}; }
    std::vector<double> operator()(double x) const { return {x}; }
    std::vector<double> operator()(const Ramp& r) const { return {double{r.root}, double{r.tip}}; }
    std::vector<double> operator()(const Vec3& v) const {
        return {double{v.x}, double{v.y}, double{v.z}};
    }
    std::vector<double> operator()(const std::string&) const { return {}; }
};

void change(mane_world& world, std::span<const mane_setting> settings) {
    SceneDesc next = world.live.scene();
    for (const mane_setting& setting : settings) {
        const Field& field = field_of(setting.key);
        if (!world.bodies.empty() && field.section == "style")
            throw InputError(field.key() +
                             ": this world's hair was given as curves, not laid by a style");
        apply(next, setting);
    }
    world.live.change(next);
    world.strands.reset();
    world.posed = false;
}

/// Text of the table with its end, as C wants it.
struct FieldText {
    std::string key, unit, help;
};
const std::vector<FieldText>& field_texts() {
    static const std::vector<FieldText> texts = [] {
        std::vector<FieldText> list;
        for (const Field& f : fields_of<SceneDesc>())
            list.push_back({f.key(), std::string(f.unit), std::string(f.help)});
        return list;
    }();
    return texts;
}

} // namespace

void apply(SceneDesc& scene, const mane_setting& setting) {
    const Field& field = field_of(setting.key);
    const Literal value = setting.text ? literal(field, setting.text)
                                       : literal(field, setting.numbers, setting.count);
    field.set(scene, interpret(field, value, "setting"));
}

} // namespace mane

using namespace mane;

size_t mane_field_count(void) {
    return fields_of<SceneDesc>().size();
}

mane_result mane_get_field(size_t index, mane_field* field) {
    return guarded([&] {
        given(field, "field");
        if (index >= mane_field_count())
            throw InputError("field " + std::to_string(index) + ": expected one of " +
                             std::to_string(mane_field_count()));
        const Field& f = fields_of<SceneDesc>()[index];
        const FieldText& text = field_texts()[index];
        mane_field known{};
        known.key = text.key.c_str(), known.unit = text.unit.c_str();
        known.help = text.help.c_str();
        known.low = f.range.low, known.high = f.range.high;
        known.live = has(f.use, FieldUse::live);
        fill_known_part(known, *field);
    });
}

mane_result mane_set(mane_world* world, const mane_setting* settings, size_t count) {
    return guarded([&] {
        if (count > 0)
            given(settings, "settings");
        change(given(world, "world"), {settings, count});
    });
}
mane_result mane_set_text(mane_world* world, const char* key, const char* text) {
    return guarded([&] {
        const mane_setting setting{key, &given(text, "text"), nullptr, 0};
        change(given(world, "world"), {&setting, 1});
    });
}
mane_result mane_set_numbers(mane_world* world, const char* key, const double* numbers,
                             size_t count) {
    return guarded([&] {
        const mane_setting setting{key, nullptr, &given(numbers, "numbers"), count};
        change(given(world, "world"), {&setting, 1});
    });
}

mane_result mane_get_numbers(const mane_world* world, const char* key, double* numbers,
                             size_t capacity, size_t* count) {
    return guarded([&] {
        const Field& field = field_of(key);
        const std::vector<double> values =
            std::visit(Numbers{}, field.get(given(world, "world").live.scene()));
        if (values.empty())
            throw InputError(field.key() + " is text; expected a field of numbers");
        given(count, "count") = values.size();
        if (capacity > 0)
            std::copy_n(values.begin(), std::min(capacity, values.size()),
                        &given(numbers, "numbers"));
    });
}

mane_result mane_get_text(const mane_world* world, const char* key, char* text, size_t capacity,
                          size_t* length) {
    return guarded([&] {
        const Value value = field_of(key).get(given(world, "world").live.scene());
        const std::string* own = std::get_if<std::string>(&value);
        const std::string whole = own ? *own : to_toml(value);
        given(length, "length") = whole.size();
        if (capacity == 0)
            return;
        given(text, "text");
        text[whole.copy(text, capacity - 1)] = '\0';
    });
}
