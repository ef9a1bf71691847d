#include "strands/drawn_envelope.h"

#include "mane/error.h"
#include "model/section_frames.h"
#include "model/state.h"
#include "strands/catmull_rom.h"

#include <algorithm>
#include <span>
#include <string>

namespace mane {
namespace {

constexpr std::size_t kWispsPerChunk = 64; // some 50 µs

void expect(const char* what, std::size_t found, std::size_t expected) {
    if (found != expected)
        throw InputError("the frame does not fit the groom: it has " + std::to_string(found) + " " +
                         what + ", expected " + std::to_string(expected));
}

float cross(DiscPoint a, DiscPoint b) {
    return a.x * b.y - a.y * b.x;
}
float dot(DiscPoint a, DiscPoint b) {
    return a.x * b.x + a.y * b.y;
}

} // namespace

DrawnEnvelope::DrawnEnvelope(const Groom& groom) : first_section_(groom.first_section) {
    const std::vector<HalfLine> lines = mane::half_lines(groom.envelope_points);
    for (std::size_t k = 0; k < lines.size(); ++k) {
        const HalfLine before = lines[(k + lines.size() - 1) % lines.size()], here = lines[k],
                       behind = lines[(k + 1) % lines.size()];
        // of two neighbours, the sine of the angle between them
        const float area = here.cosine * behind.sine - here.sine * behind.cosine;
        forms_.push_back({{here.cosine, here.sine},
                          {behind.sine / area, -behind.cosine / area},
                          {-before.sine / area, before.cosine / area}});
    }
    std::size_t size = 0;
    for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
        first_control_.push_back(size);
        size += (pieces(w) + 3) * 3 * (lines.size() + 1);
    }
    control_.resize(size + kPadding);
}

void DrawnEnvelope::pose(const Frame& frame, Threads& threads) {
    const std::size_t wisps = first_control_.size(), sections = first_section_.back();
    expect("first axes", frame.first_axis.size(), wisps);
    expect("positions", frame.position.size(), sections);
    expect("radii", frame.radius.size(), sections * forms_.size());
    threads.run_ranges(wisps, kWispsPerChunk, [&](std::size_t first, std::size_t last) {
        for (std::size_t w = first; w < last; ++w)
            pose_wisp(frame, w);
    });
}

void DrawnEnvelope::pose_wisp(const Frame& frame, std::size_t wisp) {
    const std::size_t first = first_section_[wisp], sections = pieces(wisp) + 1;
    thread_local std::vector<SectionFrame<float>> axes;
    axes.resize(sections);
    section_frames<float>(std::span(frame.position).subspan(first, sections),
                          frame.first_axis[wisp], axes);
    float* row = control_.data() + first_control_[wisp];
    const std::size_t stride = sections + 2;
    const auto put = [&](auto&& point) {
        for (std::size_t i = 0; i < stride; ++i) { // the first and the last twice
            const Vec3 p = point(std::clamp(i, std::size_t{1}, sections) - 1);
            row[i] = p.x;
            row[stride + i] = p.y;
            row[2 * stride + i] = p.z;
        }
        row += 3 * stride;
    };
    put([&](std::size_t i) { return frame.position[first + i]; });
    for (std::size_t k = 0; k < forms_.size(); ++k)
        put([&](std::size_t i) {
            const DiscPoint d = forms_[k].direction;
            return (axes[i].u * d.x + axes[i].v * d.y) *
                   frame.radius[(first + i) * forms_.size() + k];
        });
}

DrawnEnvelope::Between DrawnEnvelope::between(DiscPoint disc) const {
    // The sector: the last half line that is not ahead of the point, going round.
    const std::uint32_t last = half_lines() - 1;
    std::uint32_t k = 0;
    while (k < last &&
           !(cross(forms_[k].direction, disc) >= 0 && cross(disc, forms_[k + 1].direction) > 0))
        ++k;
    return {k, dot(forms_[k].behind, disc), dot(forms_[k < last ? k + 1 : 0].before, disc)};
}

Vec3 DrawnEnvelope::curve(std::size_t wisp, std::uint32_t which, std::uint32_t piece,
                          float t) const {
    const std::size_t stride = pieces(wisp) + 3;
    const float* x = control(wisp) + which * 3 * stride + piece;
    const CatmullRomWeights weights(t);
    return {weights.at(x), weights.at(x + stride), weights.at(x + 2 * stride)};
}

Vec3 DrawnEnvelope::at(std::size_t wisp, std::uint32_t piece, float t, DiscPoint disc) const {
    const Between place = between(disc);
    const std::uint32_t next = place.k + 1 < half_lines() ? place.k + 1 : 0;
    return curve(wisp, 0, piece, t) + curve(wisp, 1 + place.k, piece, t) * place.first +
           curve(wisp, 1 + next, piece, t) * place.second;
}

Vec3 DrawnEnvelope::centre(std::size_t wisp, std::uint32_t piece, float t) const {
    return curve(wisp, 0, piece, t);
}

} // namespace mane
