#include "formats/cache_content.h"

namespace mane {
namespace {

// Each struct's arrays are listed once, for both ways.
template <typename G, typename Visit> void visit_groom(G& g, const Visit& visit) {
    visit("first_section", "", g.first_section);
    visit("strands", "", g.strands);
    visit("thickness_power", "1", g.thickness_power);
    visit("position", "m", g.position);
    visit("radius", "m", g.radius);
    visit("skeleton_mass", "kg", g.skeleton_mass);
    visit("envelope_mass", "kg", g.envelope_mass);
    visit("stretch_stiffness", "N", g.stretch_stiffness);
    visit("stretch_damping", "N·s/m", g.stretch_damping);
    visit("rest_length", "m", g.rest_length);
    visit("bend_stiffness", "N·m/rad", g.bend_stiffness);
    visit("bend_damping", "N·m·s/rad", g.bend_damping);
    visit("rest_curvature_u", "rad", g.rest_curvature_u);
    visit("rest_curvature_v", "rad", g.rest_curvature_v);
    visit("radial_stiffness", "N/m", g.radial_stiffness);
    visit("radial_damping", "N·s/m", g.radial_damping);
    visit("ring_stiffness", "N/m", g.ring_stiffness);
    visit("ring_damping", "N·s/m", g.ring_damping);
    visit("rest_radius", "m", g.rest_radius);
    visit("ring_length", "m", g.ring_length);
}

template <typename F, typename Visit> void visit_frame(F& f, const Visit& visit) {
    visit("first_axis", "1", f.first_axis);
    visit("position", "m", f.position);
    visit("velocity", "m/s", f.velocity);
    visit("radius", "m", f.radius);
    visit("radius_rate", "m/s", f.radius_rate);
}

template <typename B, typename Visit> void visit_body(B& b, const Visit& visit) {
    visit("vertices", "m", b.mesh.vertices);
    visit("triangles", "", b.mesh.triangles);
    visit("bones", "", b.skin.bones);
    visit("weights", "1", b.skin.weights);
}

auto into(ArrayWriter& out) {
    return [&out](const char* name, const char* unit, const auto& values) {
        out.add(name, unit, values);
    };
}
auto from(const ArrayReader& in) {
    return [&in]<typename T>(const char* name, const char*, std::vector<T>& values) {
        values = in.get<T>(name);
    };
}

/// One member of all records as an array of its own.
template <typename R, typename T> void add_member(ArrayWriter& out, const std::string& name,
                                                  const char* unit, const std::vector<R>& records,
                                                  T R::*member) {
    std::vector<T> column;
    column.reserve(records.size());
    for (const R& record : records)
        column.push_back(record.*member);
    out.add(name, unit, column);
}
template <typename R, typename T> void get_member(const ArrayReader& in, const std::string& name,
                                                  std::vector<R>& records, T R::*member) {
    const std::vector<T> column = in.get<T>(name);
    if (records.empty())
        records.resize(column.size());
    if (records.size() != column.size())
        in.fail("array \"" + name + "\" is not as long as its neighbours");
    for (std::size_t i = 0; i < column.size(); ++i)
        records[i].*member = column[i];
}

std::string bone_array(std::size_t body, const char* name) {
    return "body" + std::to_string(body) + "." + name;
}

void expect_size(const ArrayReader& in, const char* name, std::size_t found, std::size_t expected) {
    if (found != expected)
        in.fail("array \"" + std::string(name) + "\" has " + std::to_string(found) +
                " entries, expected " + std::to_string(expected));
}

} // namespace

Bytes pack_text(std::string_view text) {
    ArrayWriter out;
    out.add("text", "", std::span<const char>(text));
    return out.payload();
}

std::string unpack_text(const ArrayReader& chunk) {
    const std::vector<char> text = chunk.get<char>("text");
    return {text.begin(), text.end()};
}

Bytes pack_groom(const Groom& groom) {
    ArrayWriter out;
    out.add_value("envelope_points", "", groom.envelope_points);
    add_member(out, "root.triangle", "", groom.roots, &WispRoot::triangle);
    add_member(out, "root.barycentric", "1", groom.roots, &WispRoot::barycentric);
    add_member(out, "root.inside", "m", groom.roots, &WispRoot::inside);
    add_member(out, "root.outside", "m", groom.roots, &WispRoot::outside);
    add_member(out, "root.first_axis", "1", groom.roots, &WispRoot::first_axis);
    visit_groom(groom, into(out));
    return out.payload();
}

Groom unpack_groom(const ArrayReader& chunk) {
    Groom groom;
    groom.envelope_points = chunk.get_value<std::uint32_t>("envelope_points");
    get_member(chunk, "root.triangle", groom.roots, &WispRoot::triangle);
    get_member(chunk, "root.barycentric", groom.roots, &WispRoot::barycentric);
    get_member(chunk, "root.inside", groom.roots, &WispRoot::inside);
    get_member(chunk, "root.outside", groom.roots, &WispRoot::outside);
    get_member(chunk, "root.first_axis", groom.roots, &WispRoot::first_axis);
    visit_groom(groom, from(chunk));
    expect_size(chunk, "first_section", groom.first_section.size(), groom.wisp_count() + 1);
    expect_size(chunk, "position", groom.section_count(), groom.first_section.back());
    expect_size(chunk, "radius", groom.radius.size(),
                groom.section_count() * groom.envelope_points);
    return groom;
}

Bytes pack_body(const Body& body) {
    ArrayWriter out;
    out.add("name", "", std::span<const char>(body.name));
    visit_body(body, into(out));
    out.add_value("head_bone", "", body.head_bone);
    out.add_value("worn", "", static_cast<std::uint8_t>(body.worn));
    return out.payload();
}

Body unpack_body(const ArrayReader& chunk) {
    Body body;
    const std::vector<char> name = chunk.get<char>("name");
    body.name.assign(name.begin(), name.end());
    visit_body(body, from(chunk));
    body.head_bone = chunk.get_value<std::uint32_t>("head_bone");
    body.worn = chunk.get_value<std::uint8_t>("worn") != 0;
    if (!body.skin.bones.empty()) {
        expect_size(chunk, "bones", body.skin.bones.size(), body.mesh.vertices.size());
        expect_size(chunk, "weights", body.skin.weights.size(), body.mesh.vertices.size());
    }
    return body;
}

Bytes pack_frame(const Frame& frame, const BodyPoses& poses) {
    ArrayWriter out;
    out.add_value("index", "", frame.index);
    out.add_value("time", "s", frame.time);
    out.add_value("origin", "m", frame.origin);
    visit_frame(frame, into(out));
    for (std::size_t b = 0; b < poses.size(); ++b) {
        add_member(out, bone_array(b, "position"), "m", poses[b], &BonePose::position);
        add_member(out, bone_array(b, "rotation"), "1", poses[b], &BonePose::rotation);
        add_member(out, bone_array(b, "velocity"), "m/s", poses[b], &BonePose::velocity);
        add_member(out, bone_array(b, "angular_velocity"), "rad/s", poses[b],
                   &BonePose::angular_velocity);
    }
    return out.payload();
}

Frame unpack_frame(const ArrayReader& chunk, const Groom& groom) {
    Frame frame;
    frame.index = chunk.get_value<std::uint32_t>("index");
    frame.time = chunk.get_value<double>("time");
    frame.origin = chunk.get_value<Vec3d>("origin");
    visit_frame(frame, from(chunk));
    const std::size_t sections = groom.section_count(), points = sections * groom.envelope_points;
    expect_size(chunk, "first_axis", frame.first_axis.size(), groom.wisp_count());
    expect_size(chunk, "position", frame.position.size(), sections);
    expect_size(chunk, "velocity", frame.velocity.size(), sections);
    expect_size(chunk, "radius", frame.radius.size(), points);
    expect_size(chunk, "radius_rate", frame.radius_rate.size(), points);
    return frame;
}

BodyPoses unpack_poses(const ArrayReader& chunk, std::size_t bodies) {
    BodyPoses poses(bodies);
    for (std::size_t b = 0; b < bodies; ++b) {
        get_member(chunk, bone_array(b, "position"), poses[b], &BonePose::position);
        get_member(chunk, bone_array(b, "rotation"), poses[b], &BonePose::rotation);
        get_member(chunk, bone_array(b, "velocity"), poses[b], &BonePose::velocity);
        get_member(chunk, bone_array(b, "angular_velocity"), poses[b], &BonePose::angular_velocity);
    }
    return poses;
}

Bytes pack_table(std::span<const Column> table) {
    ArrayWriter out;
    for (const Column& column : table)
        std::visit([&](const auto& values) { out.add(column.name, column.unit, values); },
                   column.values);
    return out.payload();
}

std::vector<Column> unpack_table(const ArrayReader& chunk) {
    std::vector<Column> table;
    for (const ArrayInfo& a : chunk.arrays()) {
        Column column{a.name, a.unit, {}};
        if (a.components == 1 && a.element == Element::u32)
            column.values = chunk.get<std::uint32_t>(a.name);
        else if (a.components == 1 && a.element == Element::f32)
            column.values = chunk.get<float>(a.name);
        else
            column.values = chunk.get<double>(a.name);
        table.push_back(std::move(column));
    }
    return table;
}

} // namespace mane
