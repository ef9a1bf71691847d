#pragma once

/// Paired runs: the core and the twin from the same hair on the same bodies, and how far apart what
/// they are like is. Contacts make a run chaotic: after some tenths of a second the two differ in
/// every digit, and only means can be compared.

#include "step/twin_world.h"

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace mane::test {

/// The same measure of the core and of the twin, over paired runs.
struct Paired {
    std::string name;
    double size = 0; ///< what differences are relative to; 0: the twin's mean
    std::vector<double> core = {}, twin = {};

    static double mean(const std::vector<double>& values) {
        return std::accumulate(values.begin(), values.end(), 0.0) /
               static_cast<double>(values.size());
    }
    double scale() const { return size > 0 ? size : std::fabs(mean(twin)); }
    double difference() const { return std::fabs(mean(core) - mean(twin)); }
    /// Of the mean difference.
    double standard_error() const {
        double sum = 0;
        for (std::size_t i = 0; i < core.size(); ++i) {
            const double off = core[i] - twin[i] - (mean(core) - mean(twin));
            sum += off * off;
        }
        const double n = static_cast<double>(core.size());
        return std::sqrt(sum / (n * (n - 1)));
    }
    bool agree() const { return difference() <= std::max(0.02 * scale(), 3 * standard_error()); }
};

struct Pair {
    Groom groom;
    World core;
    TwinWorld twin;

    Pair(const SimulationDesc& desc, const std::vector<Body>& bodies, const Groom& g)
        : groom(g), core(desc, g, bodies), twin(desc, g, bodies) {}
    void advance() {
        core.advance();
        twin.advance();
    }
    reference::Hair core_hair() const {
        reference::Hair hair(groom);
        set_state(hair, core.frame());
        return hair;
    }
};

} // namespace mane::test
