#pragma once

/// The table of fields: every parameter of a scene, declared once. The scene reader, `--set`, `mane
/// help scene` and the JSON schema are made from it; a value's default is the one of the
/// default-constructed struct.

#include "mane/desc.h"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace mane {

struct SceneDesc;
struct ObstacleDesc;
struct ObstacleKeyDesc;

/// A field's value. Enumerations are strings, one of the field's choices.
using Value = std::variant<bool, std::uint32_t, float, double, Ramp, Vec3, std::string>;

/// A value as a person wrote it, in a scene file or on the command line, before it is known what it
/// is for.
struct Literal {
    std::variant<bool, std::int64_t, double, std::string, std::vector<Literal>> value;
};

/// What may be done with a field.
enum class FieldUse : std::uint8_t {
    fixed = 0,    ///< known before a run starts
    live = 1,     ///< may change while it runs (M46)
    per_wisp = 2, ///< `[[override]]` may give some wisps another value
    path = 4,     ///< a file; relative paths start at the scene file
};
constexpr FieldUse operator|(FieldUse a, FieldUse b) {
    return static_cast<FieldUse>(static_cast<int>(a) | static_cast<int>(b));
}
constexpr bool has(FieldUse set, FieldUse use) {
    return (static_cast<int>(set) & static_cast<int>(use)) != 0;
}

/// The numbers that a field takes, both ends included; for vectors and ramps, each component.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
};

/// What is known of a field, whatever struct it belongs to.
struct FieldInfo {
    std::string_view section; ///< `[section]` of the scene file
    std::string_view name;
    std::string_view unit; ///< as in the struct's comment; empty for switches, choices and text
    Range range;
    FieldUse use = FieldUse::fixed;
    std::string_view help;
    std::vector<std::string_view> choices; ///< the names of an enumeration
    Value standard;                        ///< the default

    std::string key() const { return std::string(section) + "." + std::string(name); }
};

/// A field of the struct `Root`, with typed access to it.
template <typename Root> struct FieldOf : FieldInfo {
    Value (*get)(const Root&) = nullptr;
    /// `value` must hold the same alternative as `standard`.
    void (*set)(Root&, const Value&) = nullptr;
};
using Field = FieldOf<SceneDesc>;

/// The fields of a struct, section by section: of a scene, of one `[[obstacle]]` or of one
/// `[[obstacle.key]]`.
template <typename Root> std::span<const FieldOf<Root>> fields_of();
template <> std::span<const FieldOf<SceneDesc>> fields_of();
template <> std::span<const FieldOf<ObstacleDesc>> fields_of();
template <> std::span<const FieldOf<ObstacleKeyDesc>> fields_of();
/// What is known of all of them, in this order.
std::span<const FieldInfo* const> all_fields();

/// The field with this section and name, or null.
template <typename Root = SceneDesc>
const FieldOf<Root>* find_field(std::string_view section, std::string_view name) {
    for (const FieldOf<Root>& f : fields_of<Root>())
        if (f.section == section && f.name == name)
            return &f;
    return nullptr;
}

/// What a literal means for a field. Numbers may carry a unit: `"6 cm"`. Throws InputError
/// "`where`: `key`: found …, expected …" for a wrong type, unit or choice, or a number out of
/// range.
Value interpret(const FieldInfo& field, const Literal& literal, const std::string& where);

/// What a field expects, in words: `a number from 0 to 1 [m]`.
std::string expectation(const FieldInfo& field);

/// The one of `names` with the smallest edit distance to `name`; empty when none is similar.
std::string nearest_name(std::string_view name, std::span<const std::string> names);
/// " (did you mean …?)" with the nearest key of a scene, or the section's keys when none is
/// similar.
std::string suggestion(std::string_view section, std::string_view name);

/// A value as the scene file writes it; reading it back gives the same bits.
std::string to_toml(const Value& value);

/// The reference of all fields, as `mane help scene` prints it.
std::string scene_help();
/// The reference of one section; empty if there is none of this name.
std::string section_help(std::string_view section);

} // namespace mane
