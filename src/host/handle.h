#pragma once

#include "mane/driven.h"
#include "mane/error.h"
#include "mane/live_scene.h"
#include "mane/mane.h"
#include "mane/strands.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

/// What the flat C interface hands out.
struct mane_world {
    mane_world(mane::LiveScene live_, std::shared_ptr<mane::DrivenBust> bust_,
               std::vector<std::shared_ptr<mane::DrivenMotion>> bodies_,
               const mane::RunOptions& options_)
        : live(std::move(live_)), bust(std::move(bust_)), bodies(std::move(bodies_)),
          options(options_) {}

    mane::LiveScene live;
    std::shared_ptr<mane::DrivenBust> bust; ///< of a scene; null: the scene's own motion
    std::vector<std::shared_ptr<mane::DrivenMotion>> bodies; ///< given as arrays, one each

    mane::RunOptions options;
    std::uint32_t samples = 0;                ///< of strands; 0: nobody has asked for any
    std::optional<mane::StrandShape> strands; ///< empty: to be made for the parameters of now
    bool posed = false;                       ///< whether they are at the present frame
};

namespace mane {

/// What the exception that is being handled means, with its message for `mane_last_error`.
mane_result result_of_exception() noexcept;
/// Runs `work`; nothing that it throws gets out.
template <typename Work> mane_result guarded(Work&& work) noexcept {
    try {
        work();
        return MANE_OK;
    } catch (...) {
        return result_of_exception();
    }
}

/// What a caller gave, checked: throws InputError "`name` is NULL".
template <typename T> T& given(T* pointer, const char* name) {
    if (!pointer)
        throw InputError(std::string(name) + " is NULL");
    return *pointer;
}
/// A struct of the caller's with as many members as it knows; the others are 0.
template <typename T> T known_part(const T& from) {
    T whole{};
    if (from.size < sizeof from.size)
        throw InputError("a struct without its size; expected `size` to be its sizeof");
    std::copy_n(reinterpret_cast<const char*>(&from), std::min(from.size, sizeof(T)),
                reinterpret_cast<char*>(&whole));
    return whole;
}
/// The other way: fills the members that the caller knows.
template <typename T> void fill_known_part(T whole, T& to) {
    if (to.size < sizeof to.size)
        throw InputError("a struct without its size; expected `size` to be its sizeof");
    whole.size = to.size;
    std::copy_n(reinterpret_cast<const char*>(&whole), std::min(to.size, sizeof(T)),
                reinterpret_cast<char*>(&to));
}

mane_options known_options(const mane_options* options);
RunOptions run_options(const mane_options& options);

/// Sets a field of a scene. Throws InputError.
void apply(SceneDesc& scene, const mane_setting& setting);

} // namespace mane
