#include "bench/measure.h"
#include "mane/error.h"

#include <fmt/core.h>

namespace mane::tool {
namespace {

bench::Json measure(const bench::Case& c) {
    switch (c.kind) {
    case bench::Kind::strands:
    case bench::Kind::moving_strands:
        return measure_strands(c);
    case bench::Kind::cache:
        return measure_cache(c);
    case bench::Kind::machine:
        return measure_machine(c);
    case bench::Kind::simulation:
        break;
    }
    return measure_simulation(c);
}

/// Errors are an answer too: a string, which the one who asked puts into its own message.
int fail(const std::exception& error, int code) {
    fmt::print("{}\n", bench::Json(error.what()).dump());
    return code;
}

} // namespace

int bench_one(const std::string& what) {
    try {
        fmt::print("{}\n", measure(bench::from_json(bench::Json::parse(what))).dump());
        return 0;
    } catch (const InputError& error) {
        return fail(error, kBadInput);
    } catch (const std::exception& error) {
        return fail(error, kFailed);
    }
}

} // namespace mane::tool
