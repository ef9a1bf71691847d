#include "base/functions.h"
#include "mane/error.h"
#include "mane/strands.h"
#include "strands/drawn_envelope.h"

#include <algorithm>

namespace mane {
namespace {

void need_samples(std::uint32_t samples) {
    if (samples == 0)
        throw InputError("layers need at least 1 sample per segment, found 0");
}

DrawnEnvelope posed_envelope(const Groom& groom, const Frame& frame) {
    DrawnEnvelope envelope(groom);
    Threads alone(1);
    envelope.pose(frame, alone);
    return envelope;
}

struct Place {
    std::uint32_t piece;
    float t;
};
Place place(std::uint32_t sample, std::uint32_t samples, std::uint32_t pieces) {
    const std::uint32_t piece = std::min(sample / samples, pieces - 1);
    return {piece, static_cast<float>(sample - piece * samples) / static_cast<float>(samples)};
}

// Mean diameter of the drawn envelope: twice the mean distance of its half lines' ends.
float mean_diameter(const Groom& groom, const Frame& frame, std::size_t section) {
    float sum = 0;
    for (std::uint32_t k = 0; k < groom.envelope_points; ++k)
        sum += frame.radius[section * groom.envelope_points + k];
    return 2 * sum / static_cast<float>(groom.envelope_points);
}

} // namespace

Curves skeleton_curves(const Groom& groom, const Frame& frame, std::uint32_t samples_per_segment) {
    need_samples(samples_per_segment);
    const DrawnEnvelope envelope = posed_envelope(groom, frame);
    Curves curves;
    for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
        curves.first_vertex.push_back(static_cast<std::uint32_t>(curves.position.size()));
        const std::uint32_t pieces = envelope.pieces(w);
        for (std::uint32_t i = 0; i <= pieces * samples_per_segment; ++i) {
            const Place at = place(i, samples_per_segment, pieces);
            const std::size_t section = groom.first_section[w] + at.piece;
            const float a = mean_diameter(groom, frame, section),
                        b = mean_diameter(groom, frame, section + 1);
            curves.position.push_back(envelope.centre(w, at.piece, at.t));
            curves.width.push_back(a + (b - a) * at.t);
        }
    }
    curves.first_vertex.push_back(static_cast<std::uint32_t>(curves.position.size()));
    return curves;
}

Mesh envelope_mesh(const Groom& groom, const Frame& frame, std::uint32_t samples_per_segment,
                   std::uint32_t points_round) {
    need_samples(samples_per_segment);
    if (points_round < 3)
        throw InputError("an envelope's mesh needs at least 3 points round a section");
    const DrawnEnvelope envelope = posed_envelope(groom, frame);
    std::vector<DiscPoint> round;
    for (std::uint32_t j = 0; j < points_round; ++j) {
        const double angle = 2 * kPi * j / points_round;
        round.push_back({static_cast<float>(cosine(angle)), static_cast<float>(sine(angle))});
    }

    Mesh mesh;
    for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
        const std::uint32_t pieces = envelope.pieces(w), rings = pieces * samples_per_segment + 1;
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (std::uint32_t i = 0; i < rings; ++i) {
            const Place at = place(i, samples_per_segment, pieces);
            for (const DiscPoint& disc : round)
                mesh.vertices.push_back(envelope.at(w, at.piece, at.t, disc));
        }
        const std::uint32_t root = first + rings * points_round, tip = root + 1;
        mesh.vertices.push_back(envelope.centre(w, 0, 0));
        mesh.vertices.push_back(envelope.centre(w, pieces - 1, 1));

        // u × v points to the tip, so seen from outside the section runs counter-clockwise to the
        // left.
        for (std::uint32_t j = 0; j < points_round; ++j) {
            const std::uint32_t a = first + j, b = first + (j + 1) % points_round;
            const std::uint32_t above = (rings - 1) * points_round;
            mesh.triangles.push_back({root, b, a});
            for (std::uint32_t i = 0; i + 1 < rings; ++i) {
                const std::uint32_t low = i * points_round, high = low + points_round;
                mesh.triangles.push_back({a + low, b + low, b + high});
                mesh.triangles.push_back({a + low, b + high, a + high});
            }
            mesh.triangles.push_back({tip, a + above, b + above});
        }
    }
    return mesh;
}

} // namespace mane
