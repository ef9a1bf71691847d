#include "mane/scene.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace mane {
namespace {

using Json = nlohmann::ordered_json;

Json number_schema(const FieldInfo& field, const char* type) {
    Json number{{"type", type}};
    if (std::isfinite(field.range.low))
        number["minimum"] = field.range.low;
    if (std::isfinite(field.range.high))
        number["maximum"] = field.range.high;
    return number;
}

// A number, or a number with its unit in quotes.
Json quantity_schema(const FieldInfo& field) {
    return {{"anyOf", Json::array({number_schema(field, "number"),
                                   Json{{"type", "string"}, {"pattern", "^[-+.0-9]"}}})}};
}

Json list_schema(const FieldInfo& field, int count) {
    return {{"type", "array"},
            {"items", quantity_schema(field)},
            {"minItems", count},
            {"maxItems", count}};
}

struct TypeSchema {
    const FieldInfo& field;
    Json operator()(bool) const { return {{"type", "boolean"}}; }
    Json operator()(std::uint32_t) const { return number_schema(field, "integer"); }
    Json operator()(float) const { return quantity_schema(field); }
    Json operator()(double) const { return quantity_schema(field); }
    Json operator()(const Ramp&) const {
        Json either = quantity_schema(field);
        either["anyOf"].push_back(list_schema(field, 2));
        return either;
    }
    Json operator()(const Vec3&) const { return list_schema(field, 3); }
    Json operator()(const std::string&) const {
        Json text{{"type", "string"}};
        if (!field.choices.empty())
            text["enum"] = field.choices;
        return text;
    }
};

struct DefaultValue {
    static double shortest(float x) {
        return std::stod(to_toml(x));
    } // 0.005, not 0.004999999888241291
    Json operator()(float x) const { return shortest(x); }
    Json operator()(const Ramp& r) const { return {shortest(r.root), shortest(r.tip)}; }
    Json operator()(const Vec3& v) const { return {shortest(v.x), shortest(v.y), shortest(v.z)}; }
    template <typename T> Json operator()(const T& other) const { return other; }
};

Json field_schema(const FieldInfo& field) {
    Json schema = std::visit(TypeSchema{field}, field.standard);
    schema["description"] =
        (field.unit.empty() ? "" : "[" + std::string(field.unit) + "] ") + std::string(field.help);
    schema["default"] = std::visit(DefaultValue{}, field.standard);
    if (has(field.use, FieldUse::live))
        schema["x-live"] =
            true; // of no meaning to JSON schema; the live page makes its sliders from it
    return schema;
}

Json closed_object() {
    return {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
}

Json table_list(Json table) {
    return {{"type", "array"}, {"items", std::move(table)}};
}

template <typename Root> Json table_schema() {
    Json schema = closed_object();
    for (const FieldOf<Root>& f : fields_of<Root>())
        schema["properties"][std::string(f.name)] = field_schema(f);
    return schema;
}

/// The sections of a scene, with the fields for which `wanted` is true.
template <typename Wanted> Json sections_schema(const Wanted& wanted) {
    Json schema = closed_object();
    for (const Field& f : fields_of<SceneDesc>()) {
        if (!wanted(f))
            continue;
        Json& sections = schema["properties"];
        const std::string section(f.section);
        if (!sections.contains(section))
            sections[section] = closed_object();
        sections[section]["properties"][std::string(f.name)] = field_schema(f);
    }
    return schema;
}

Json obstacle_schema() {
    Json obstacle = table_schema<ObstacleDesc>();
    obstacle["properties"]["key"] = table_list(table_schema<ObstacleKeyDesc>());
    return obstacle;
}

Json override_schema() {
    Json each = sections_schema([](const Field& f) { return has(f.use, FieldUse::per_wisp); });
    each["properties"]["wisps"] = {
        {"type", "array"}, {"items", {{"type", "integer"}, {"minimum", 0}}}, {"minItems", 1}};
    each["required"] = {"wisps"};
    return each;
}

} // namespace

std::string scene_schema() {
    Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                {"title", "mane scene"}};
    schema.update(sections_schema([](const Field&) { return true; }));
    schema["properties"]["obstacle"] = table_list(obstacle_schema());
    schema["properties"]["override"] = table_list(override_schema());
    return schema.dump(2) + "\n";
}

} // namespace mane
