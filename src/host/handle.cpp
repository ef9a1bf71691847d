#include "host/handle.h"

#include <exception>
#include <new>
#include <string>

namespace {
thread_local std::string last_error;

mane_result failed(mane_result result, const char* message) noexcept {
    try {
        last_error = message;
    } catch (...) {
        last_error.clear();
    }
    return result;
}
} // namespace

namespace mane {

mane_result result_of_exception() noexcept {
    try {
        throw;
    } catch (const InputError& error) {
        return failed(MANE_INPUT_ERROR, error.what());
    } catch (const SimulationError& error) {
        return failed(MANE_SIMULATION_ERROR, error.what());
    } catch (const std::bad_alloc&) {
        return failed(MANE_OUT_OF_MEMORY, "out of memory");
    } catch (const std::exception& error) {
        return failed(MANE_INTERNAL_ERROR, error.what());
    } catch (...) {
        return failed(MANE_INTERNAL_ERROR, "an unknown exception");
    }
}

mane_options known_options(const mane_options* options) {
    return options ? known_part(*options) : mane_options{};
}

RunOptions run_options(const mane_options& options) {
    RunOptions run;
    run.threads = options.threads == MANE_ALL_THREADS ? 0 : std::max(options.threads, 1u);
    if (options.instruction_set)
        run.instruction_set = options.instruction_set;
    return run;
}

} // namespace mane

const char* mane_last_error(void) {
    return last_error.c_str();
}
const char* mane_version(void) {
    return MANE_VERSION;
}
