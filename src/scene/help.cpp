#include "mane/fields.h"

#include "mane/scene.h"
#include "scene/number.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mane {
namespace {

constexpr const char* kIntroduction =
    R"(Scene files are TOML: [section] headings over lines of key = value. What is left out has its default.

    [skeleton]
    strain = 0.004              # a number in the unit of the field
    bending_length = "6 cm"     # or with another unit that measures the same
    [envelope]
    stiffness = [1, 0.25]       # from root to tip
    [[override]]                # other values for some wisps
    wisps = [3, 4]
    skeleton.strain = 0.01

On the command line: --set skeleton.strain=0.004 --set wisps.mode=off --set air.wind=[2,0,0]
Files named in a scene are found from the scene's folder. L: may change while it runs. W: may differ per wisp.
)";

// Letters, not bytes: "µ" and "²" take two.
std::size_t width(std::string_view text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string padded(std::string text, std::size_t columns) {
    const std::size_t w = width(text);
    return w < columns ? text.append(columns - w, ' ') : text + " ";
}

std::string accepted(const FieldInfo& f) {
    if (!f.choices.empty()) {
        std::string text;
        for (const std::string_view choice : f.choices)
            text += (text.empty() ? "" : " | ") + std::string(choice);
        return text;
    }
    if (std::holds_alternative<bool>(f.standard))
        return "true | false";
    if (std::holds_alternative<std::string>(f.standard))
        return has(f.use, FieldUse::path) ? "a file" : "text";
    std::string text;
    if (std::isfinite(f.range.low))
        text = shortest(f.range.low) + " …";
    if (std::isfinite(f.range.high))
        text += (text.empty() ? "… " : " ") + shortest(f.range.high);
    return text;
}

std::string letters(const FieldInfo& f) {
    std::string text = has(f.use, FieldUse::live) ? "L" : " ";
    return text + (has(f.use, FieldUse::per_wisp) ? "W" : "");
}

/// Adds `text` in lines of at most 100 columns.
void wrap(std::string& out, std::string_view text, std::size_t indent) {
    std::istringstream words{std::string(text)};
    std::string line(indent, ' '), word;
    for (bool first = true; words >> word; first = false) {
        if (!first && width(line) + width(word) >= 100) {
            out += line + "\n";
            line.assign(indent, ' ');
            first = true;
        }
        line += (first ? "" : " ") + word;
    }
    out += line + "\n";
}

void add_field(std::string& out, const FieldInfo& f) {
    std::string line = padded("  " + std::string(f.name), 24) + padded(to_toml(f.standard), 20);
    line = padded(line + padded(f.unit.empty() ? "" : "[" + std::string(f.unit) + "]", 8) +
                      accepted(f),
                  82) +
           letters(f);
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    wrap(out, f.help, 6);
}

std::string title(std::string_view section) {
    const std::string name(section);
    return section.starts_with("obstacle") ? "[[" + name + "]]" : "[" + name + "]";
}

} // namespace

std::string section_help(std::string_view section) {
    std::string out;
    for (const FieldInfo* f : all_fields())
        if (f->section == section)
            add_field(out, *f);
    return out.empty() ? out : "\n" + title(section) + "\n" + out;
}

std::string scene_help() {
    std::string out = kIntroduction;
    std::string_view section;
    for (const FieldInfo* f : all_fields()) {
        if (f->section == section)
            continue;
        section = f->section;
        out += section_help(section);
    }
    return out;
}

} // namespace mane
