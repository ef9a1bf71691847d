#include "strands/drawn_envelope.h"

#include "mane/error.h"
#include "model/section_frames.h"
#include "model/state.h"

#include <span>
#include <string>

namespace mane {
namespace {

void check_fit(const Groom& groom, const Frame& frame) {
    const auto expect = [](const char* what, std::size_t found, std::size_t expected) {
        if (found != expected)
            throw InputError("the frame does not fit the groom: it has " + std::to_string(found) +
                             " " + what + ", expected " + std::to_string(expected));
    };
    expect("first axes", frame.first_axis.size(), groom.wisp_count());
    expect("positions", frame.position.size(), groom.section_count());
    expect("radii", frame.radius.size(), groom.section_count() * groom.envelope_points);
}

float cross(DiscPoint a, DiscPoint b) {
    return a.x * b.y - a.y * b.x;
}
float dot(DiscPoint a, DiscPoint b) {
    return a.x * b.x + a.y * b.y;
}

} // namespace

DrawnEnvelope::DrawnEnvelope(const Groom& groom, const Frame& frame)
    : half_lines_(groom.envelope_points) {
    check_fit(groom, frame);
    const std::vector<HalfLine> lines = half_lines(half_lines_);
    for (std::uint32_t k = 0; k < half_lines_; ++k) {
        const HalfLine a = lines[k], b = lines[(k + 1) % half_lines_];
        const float area = a.cosine * b.sine - a.sine * b.cosine;
        sectors_.push_back({{a.cosine, a.sine},
                            {b.sine / area, -b.cosine / area},
                            {-a.sine / area, a.cosine / area}});
    }

    std::vector<SectionFrame<float>> axes;
    for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
        const std::size_t first = groom.first_section[w], sections = groom.sections(w),
                          last = sections - 1;
        axes.resize(sections);
        section_frames<float>(std::span(frame.position).subspan(first, sections),
                              frame.first_axis[w], axes);
        const auto centre = [&](std::size_t i) { return frame.position[first + i]; };
        first_piece_.push_back(curves_.size() / (half_lines_ + 1));
        pieces_.push_back(static_cast<std::uint32_t>(last));
        for (std::size_t i = 0; i < last; ++i) {
            curves_.push_back(catmull_rom_piece(centre, i, last));
            for (std::uint32_t k = 0; k < half_lines_; ++k) {
                const auto end = [&](std::size_t s) {
                    const float r = frame.radius[(first + s) * half_lines_ + k];
                    return (axes[s].u * lines[k].cosine + axes[s].v * lines[k].sine) * r;
                };
                curves_.push_back(catmull_rom_piece(end, i, last));
            }
        }
    }
}

Vec3 DrawnEnvelope::at(std::size_t wisp, std::uint32_t piece, float t, DiscPoint disc) const {
    // The sector: the last half line that is not ahead of the point, going round.
    std::uint32_t k = 0;
    while (k + 1 < half_lines_ &&
           !(cross(sectors_[k].direction, disc) >= 0 && cross(disc, sectors_[k + 1].direction) > 0))
        ++k;
    const std::uint32_t next = k + 1 < half_lines_ ? k + 1 : 0;
    const CatmullRom<Vec3>* curves = piece_curves(wisp, piece);
    return curves[0].at(t) + curves[1 + k].at(t) * dot(sectors_[k].to_first, disc) +
           curves[1 + next].at(t) * dot(sectors_[k].to_second, disc);
}

Vec3 DrawnEnvelope::centre(std::size_t wisp, std::uint32_t piece, float t) const {
    return piece_curves(wisp, piece)->at(t);
}

} // namespace mane
