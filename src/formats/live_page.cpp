#include "mane/live_page.h"

#include "formats/page_payload.h"
#include "formats/text.h"
#include "mane/error.h"
#include "mane/scene.h"

namespace mane {
namespace {

/// The page's disk: relative names of a scene start here.
constexpr const char* kPageFolder = "/";

/// All files that a scene names, in the order of its fields and lists.
std::vector<std::string> named_files(const SceneDesc& scene) {
    std::vector<std::string> files;
    const auto add = [&]<typename Root>(const Root& root) {
        for (const FieldOf<Root>& f : fields_of<Root>())
            if (has(f.use, FieldUse::path))
                files.push_back(std::get<std::string>(f.get(root)));
    };
    add(scene);
    for (const ObstacleDesc& obstacle : scene.obstacles)
        add(obstacle);
    return files;
}

/// Text as a script element holds it: nothing in it may end the element.
std::string in_script(std::string_view text) {
    std::string safe;
    for (std::size_t i = 0; i < text.size(); ++i) {
        safe += text[i];
        if (text[i] == '<' && i + 1 < text.size() && text[i + 1] == '/')
            safe += '\\'; // the same in strings of JavaScript and JSON
    }
    return safe;
}

std::string element(const char* type, const char* id, const std::string& content) {
    return "<script type=\"" + std::string(type) + "\" id=\"" + id + "\">" + content +
           "</script>\n";
}

std::string scene_json(const PackedScene& scene) {
    nlohmann::ordered_json json{{"name", scene.name}, {"text", scene.text}};
    json["files"] = nlohmann::ordered_json::array();
    for (const auto& [path, bytes] : scene.files)
        json["files"].push_back({{"path", path}, {"bytes", base64(bytes)}});
    return json.dump();
}

} // namespace

PackedScene pack_scene(const std::filesystem::path& file, const std::vector<std::string>& settings,
                       const std::string& rates) {
    PackedScene packed{file.filename().string(), read_text(file.string()), {}};
    const std::vector<std::string> here =
        named_files(parse_scene(packed.text, file.string(), file.parent_path()));
    SceneDesc scene = parse_scene(packed.text, file.string(), kPageFolder);
    const std::vector<std::string> there = named_files(scene);
    for (std::size_t i = 0; i < here.size(); ++i)
        if (!here[i].empty())
            packed.files.emplace_back(there[i], read_text(here[i]));
    if (!rates.empty())
        apply_rates(scene, rates);
    for (const std::string& setting : settings)
        apply_setting(scene, setting);
    if (!rates.empty() || !settings.empty())
        packed.text = write_scene(scene);
    return packed;
}

std::string live_page(const LivePageDesc& desc) {
    std::string parts = element("text/plain", "solver-script", in_script(desc.script)) +
                        element("text/plain", "solver-module", base64(deflated(desc.module)));
    if (!desc.threaded.empty())
        parts += element("application/json", "solver-threads",
                         nlohmann::json{{"script", desc.threaded}}.dump());
    if (desc.scene)
        parts += element("application/json", "scene", in_script(scene_json(*desc.scene)));
    constexpr std::string_view kPlace = "<!-- solver -->";
    const std::size_t place = desc.page.find(kPlace);
    if (place == std::string_view::npos)
        throw InputError("a page without the line " + std::string(kPlace));
    return std::string(desc.page.substr(0, place)) + parts +
           std::string(desc.page.substr(place + kPlace.size()));
}

} // namespace mane
