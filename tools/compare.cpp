#include "commands.h"

#include "mane/cache.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace mane::tool {
namespace {

/// Differences of one layer, gathered over all frames.
struct Layer {
    const char* name;
    const char* unit;
    double largest = 0, squares = 0;
    std::size_t count = 0;
    std::optional<std::size_t> first_frame{},
        worst_frame{}; ///< first that differs beyond the tolerance

    double rms() const { return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0; }

    void add(std::size_t frame, double difference, double tolerance) {
        if (std::isnan(difference))
            difference = INFINITY;
        squares += difference * difference;
        ++count;
        if (difference > largest)
            largest = difference, worst_frame = frame;
        if (difference > tolerance && !first_frame)
            first_frame = frame;
    }
};

double difference(float a, float b) {
    return a == b ? 0 : std::fabs(static_cast<double>(a) - static_cast<double>(b));
}
double difference(const Vec3& a, const Vec3& b) {
    return a == b ? 0 : length(Vec3d(a) - Vec3d(b));
}

struct Comparison {
    const CacheReader& a;
    const CacheReader& b;
    double tolerance;
    Layer skeleton{"skeleton", "m"}, velocity{"velocity", "m/s"}, envelope{"envelope", "m"},
        rate{"envelope rate", "m/s"}, character{"character", "m"};
    std::vector<std::string> differences{}; ///< of what cannot be subtracted

    Layer* layers[5] = {&skeleton, &velocity, &envelope, &rate, &character};

    bool same_hair() {
        const Groom &ga = a.setup().groom, &gb = b.setup().groom;
        if (ga.first_section == gb.first_section && ga.envelope_points == gb.envelope_points)
            return true;
        differences.push_back(fmt::format("{} wisps with {} sections, the other {} with {}",
                                          ga.wisp_count(), ga.section_count(), gb.wisp_count(),
                                          gb.section_count()));
        return false;
    }

    /// Bodies are compared where both have as many vertices.
    std::size_t same_bodies() {
        const auto &ba = a.setup().bodies, &bb = b.setup().bodies;
        if (ba.size() != bb.size())
            differences.push_back(fmt::format("{} bodies, the other {}", ba.size(), bb.size()));
        for (std::size_t i = 0; i < std::min(ba.size(), bb.size()); ++i)
            if (ba[i].mesh.vertices.size() != bb[i].mesh.vertices.size()) {
                differences.push_back(fmt::format("body {} has {} vertices, the other {}",
                                                  ba[i].name, ba[i].mesh.vertices.size(),
                                                  bb[i].mesh.vertices.size()));
                return i;
            }
        return std::min(ba.size(), bb.size());
    }

    template <typename T>
    void add(Layer& layer, std::size_t frame, std::span<const T> x, std::span<const T> y) const {
        for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
            layer.add(frame, difference(x[i], y[i]), tolerance);
    }

    void compare_frame(std::size_t i, bool hair, std::size_t bodies) {
        const Frame fa = a.frame(i), fb = b.frame(i);
        const Vec3d shift =
            fb.origin - fa.origin; // positions are relative to origins that may differ
        if (hair) {
            for (std::size_t s = 0; s < fa.position.size(); ++s)
                skeleton.add(i, length(Vec3d(fb.position[s]) - Vec3d(fa.position[s]) + shift),
                             tolerance);
            add<Vec3>(velocity, i, fa.velocity, fb.velocity);
            add<float>(envelope, i, fa.radius, fb.radius);
            add<float>(rate, i, fa.radius_rate, fb.radius_rate);
        }
        for (std::size_t body = 0; body < bodies; ++body) {
            const std::vector<Vec3> va = a.body_vertices(i, body), vb = b.body_vertices(i, body);
            for (std::size_t v = 0; v < va.size(); ++v)
                character.add(i, length(Vec3d(vb[v]) - Vec3d(va[v]) + shift), tolerance);
        }
    }

    void run() {
        const bool hair = same_hair();
        const std::size_t bodies = same_bodies();
        if (a.frame_count() != b.frame_count())
            differences.push_back(
                fmt::format("{} frames, the other {}", a.frame_count(), b.frame_count()));
        for (std::size_t i = 0; i < std::min(a.frame_count(), b.frame_count()); ++i)
            compare_frame(i, hair, bodies);
    }

    std::optional<std::size_t> first_frame() const {
        std::optional<std::size_t> first;
        for (const Layer* layer : layers)
            if (layer->first_frame)
                first = std::min(*layer->first_frame, first.value_or(*layer->first_frame));
        return first;
    }
};

void print_text(const Comparison& c) {
    for (const std::string& d : c.differences)
        fmt::print("different: {}\n", d);
    fmt::print("{:15} {:>13} {:>13}        first frame that differs\n", "layer", "largest", "rms");
    for (const Layer* layer : c.layers)
        fmt::print("{:15} {:13.6g} {:13.6g} {:5}  {}\n", layer->name, layer->largest, layer->rms(),
                   layer->unit, layer->first_frame ? std::to_string(*layer->first_frame) : "none");
}

void print_json(const Comparison& c, bool same) {
    using Json = nlohmann::ordered_json;
    const auto frame = [](std::optional<std::size_t> f) { return f ? Json(*f) : Json(); };
    Json layers = Json::object();
    for (const Layer* layer : c.layers)
        layers[layer->name] = {{"unit", layer->unit},
                               {"largest", layer->largest},
                               {"rms", layer->rms()},
                               {"first_frame", frame(layer->first_frame)},
                               {"worst_frame", frame(layer->worst_frame)}};
    const Json all{{"same", same},
                   {"tolerance", c.tolerance},
                   {"first_frame", frame(c.first_frame())},
                   {"differences", c.differences},
                   {"layers", layers}};
    fmt::print("{}\n", all.dump(2));
}

} // namespace

int compare(const CompareOptions& options) {
    const CacheReader a(options.first), b(options.second);
    Comparison comparison{a, b, options.tolerance};
    comparison.run();
    const bool same = comparison.differences.empty() && !comparison.first_frame();
    if (options.json)
        print_json(comparison, same);
    else
        print_text(comparison);
    return same ? 0 : kDifferent;
}

} // namespace mane::tool
