#include "bench/child.h"
#include "bench/results.h"
#include "interrupt.h"
#include "progress.h"

#include "base/whole_file.h"

#include <fmt/core.h>

#include <stdexcept>

namespace mane::tool {
namespace {

using namespace bench;

/// Runs all cases once, again and again: what disturbs the machine for a while then disturbs one
/// run of each, and not all runs of one. Stops at a signal, with the rounds that are whole.
std::vector<Result> measure(const std::vector<Case>& cases, std::uint32_t runs,
                            const Interrupt& interrupt) {
    std::vector<Result> results;
    results.reserve(cases.size());
    for (const Case& c : cases)
        results.push_back({c, {}, {}});
    Progress progress(cases.size() * runs, "run");
    std::size_t done = 0;
    for (std::uint32_t round = 0; round < runs; ++round) {
        std::vector<Json> figures;
        for (Case c : cases) {
            c.judge = round == 0;
            std::optional<Json> run = run_in_child(c, interrupt);
            if (!run)
                return results;
            figures.push_back(std::move(*run));
            progress.show(++done);
        }
        for (std::size_t i = 0; i < cases.size(); ++i)
            results[i].runs.push_back(std::move(figures[i]));
    }
    return results;
}

/// M39: a case that does not end in the same bits every time has no figures.
void require_same_bits(const Result& result) {
    for (const Json& run : result.runs)
        if (run.value("state_hash", "") != result.runs.front().value("state_hash", ""))
            throw std::runtime_error(result.what.name + ": runs end in different states");
}

void write(const std::string& path, const std::string& text) {
    WholeFile file(path);
    file.write(text);
    file.finish();
}

int list(const std::vector<Case>& cases) {
    for (const Case& c : cases)
        fmt::print("{}\n", c.name);
    return 0;
}

} // namespace

int bench(const BenchOptions& options) {
    const std::vector<Case> cases = selected(all_cases(options), options.only);
    if (options.list)
        return list(cases);
    const Interrupt interrupt;
    std::vector<Result> results = measure(cases, options.runs, interrupt);
    const auto runs = static_cast<std::uint32_t>(results.front().runs.size());
    if (runs > 0) {
        for (Result& result : results) {
            require_same_bits(result);
            result.medians = median(result.runs);
        }
        const Circumstances where = circumstances(runs);
        if (!options.json.empty())
            write(options.json, to_json(where, results));
        if (!options.csv.empty())
            write_csv(where, results, options.csv);
        fmt::print("{}", to_tables(where, results));
    }
    if (!interrupt.signal())
        return 0;
    fmt::print(stderr, "mane: interrupted after {} of {} rounds\n", runs, options.runs);
    return 128 + interrupt.signal();
}

} // namespace mane::tool
