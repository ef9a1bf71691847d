#include "formats/page_contacts.h"

#include "mane/cache.h"
#include "mane/contact.h"
#include "mane/error.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

/// [1] Octaves of strength are told apart in as many steps: 1 % each way.
constexpr float kStepsPerOctave = 32;
constexpr float kWeakest = 60; // octaves under 1 N·s, or 1 m; what is weaker counts as none

/// 0 for none, else steps above the weakest.
std::uint32_t strength_steps(float strength) {
    if (!(strength > 0))
        return 0;
    const float steps = std::round((std::log2(strength) + kWeakest) * kStepsPerOctave);
    return steps < 1 ? 0 : static_cast<std::uint32_t>(steps);
}

/// A unit vector as a point of the octahedron's unfolded surface, 8 bits each way: 0.5°.
std::array<std::uint32_t, 2> octahedral(const Vec3& v) {
    const float sum = std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
    if (sum == 0)
        return {127, 127};
    float x = v.x / sum, y = v.y / sum;
    if (v.z < 0) {
        const float folded = (1 - std::abs(y)) * (x < 0 ? -1.f : 1.f);
        y = (1 - std::abs(x)) * (y < 0 ? -1.f : 1.f);
        x = folded;
    }
    const auto bits = [](float c) {
        return static_cast<std::uint32_t>(std::round((c * 0.5f + 0.5f) * 254));
    };
    return {bits(x), bits(y)};
}

std::uint32_t share_in_steps(float share) {
    return static_cast<std::uint32_t>(std::round(std::clamp(share, 0.f, 1.f) * 255));
}

/// A table's columns by their names.
class Table {
  public:
    Table(std::vector<Column> columns, std::size_t frame)
        : columns_(std::move(columns)), frame_(frame) {}
    bool empty() const { return columns_.empty(); }
    template <typename T> const std::vector<T>& get(std::string_view name) const {
        for (const Column& column : columns_)
            if (column.name == name)
                if (const auto* values = std::get_if<std::vector<T>>(&column.values))
                    return *values;
        throw InputError("the contacts of frame " + std::to_string(frame_) + " have no column " +
                         std::string(name));
    }

  private:
    std::vector<Column> columns_;
    std::size_t frame_;
};

/// The columns that a page reads.
struct Columns {
    std::vector<std::uint32_t> count; // per frame
    std::vector<std::uint32_t> kind, point, section, along, other, other_along, body;
    std::vector<std::uint32_t> strength, direction_x, direction_y;

    void add_contacts(const Table& table) {
        const auto& sections = table.get<std::uint32_t>("section");
        count.push_back(static_cast<std::uint32_t>(sections.size()));
        take(table, kind, "kind");
        take(table, point, "point");
        take(table, other, "other");
        take(table, body, "body");
        for (const float x : table.get<float>("along"))
            along.push_back(share_in_steps(x));
        for (const float x : table.get<float>("other_along"))
            other_along.push_back(share_in_steps(x));
        before_ = 0;
        add_sections(sections);
        add_vectors(table, "impulse");
    }

    /// Penetration reactions, as one more kind, behind the contacts of their frame.
    void add_reactions(const Table& table) {
        const auto& sections = table.get<std::uint32_t>("section");
        count.back() += static_cast<std::uint32_t>(sections.size());
        kind.insert(kind.end(), sections.size(), kReaction);
        along.insert(along.end(), sections.size(), 0);
        other_along.insert(other_along.end(), sections.size(), 0);
        take(table, point, "point");
        take(table, other, "triangle");
        take(table, body, "body");
        add_sections(sections);
        add_vectors(table, "shift");
    }

  private:
    static constexpr std::uint32_t kReaction = 3;

    static void take(const Table& table, std::vector<std::uint32_t>& out, const char* name) {
        const auto& values = table.get<std::uint32_t>(name);
        out.insert(out.end(), values.begin(), values.end());
    }

    /// As differences modulo 2³²: wisps' contacts come before bodies', each by rising sections.
    void add_sections(const std::vector<std::uint32_t>& sections) {
        for (const std::uint32_t s : sections) {
            section.push_back(s - before_);
            before_ = s;
        }
    }

    void add_vectors(const Table& table, const std::string& name) {
        const auto &x = table.get<float>(name + "_x"), &y = table.get<float>(name + "_y"),
                   &z = table.get<float>(name + "_z");
        for (std::size_t i = 0; i < x.size(); ++i) {
            const Vec3 v{x[i], y[i], z[i]};
            const auto [across, up] = octahedral(v);
            strength.push_back(strength_steps(length(v)));
            direction_x.push_back(across);
            direction_y.push_back(up);
        }
    }

    std::uint32_t before_ = 0; // the last section of the frame so far
};

} // namespace

void add_contacts(const CacheReader& run, PagePayload& payload) {
    Columns columns;
    for (std::size_t i = 0; i < run.frame_count(); ++i) {
        const auto number = static_cast<std::uint32_t>(i);
        const Table contacts(run.table("CONT", number), i), reactions(run.table("REAC", number), i);
        if (contacts.empty() || reactions.empty())
            return; // the run was not recorded, or not to its end
        columns.add_contacts(contacts);
        columns.add_reactions(reactions);
    }
    payload.header()["contacts"] = {{"strength_steps_per_octave", kStepsPerOctave},
                                    {"weakest_octave", -kWeakest}};
    payload.add_planes("contact.count", columns.count);
    payload.add_planes("contact.kind", columns.kind);
    payload.add_planes("contact.point", columns.point);
    payload.add_planes("contact.section", columns.section);
    payload.add_planes("contact.along", columns.along);
    payload.add_planes("contact.other", columns.other);
    payload.add_planes("contact.other_along", columns.other_along);
    payload.add_planes("contact.body", columns.body);
    payload.add_planes("contact.strength", columns.strength);
    payload.add_planes("contact.direction_x", columns.direction_x);
    payload.add_planes("contact.direction_y", columns.direction_y);
}

} // namespace mane
