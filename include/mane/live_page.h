#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Hair that is simulated in a browser: the solver as WebAssembly in one HTML file, which opens
/// from disk, without a network.

namespace mane {

struct SceneDesc;

/// A scene with the files it names, as a page takes them along.
struct PackedScene {
    std::string name;                                       ///< of its file, for messages
    std::string text;                                       ///< TOML
    std::vector<std::pair<std::string, std::string>> files; ///< names as the page finds them; bytes
};

/// Reads a scene and all it names. With `settings` (`section.key=value`) or a preset of the rates
/// it is written out anew, else it stays word for word. Throws InputError.
PackedScene pack_scene(const std::filesystem::path& file,
                       const std::vector<std::string>& settings = {},
                       const std::string& rates = {});

/// What a page of hair is made of.
struct LivePageDesc {
    std::string_view page;   ///< HTML with the line `<!-- solver -->`
    std::string_view script; ///< JavaScript that makes the solver
    std::string_view module; ///< WebAssembly
    std::string threaded; ///< address of the script of a solver with threads; empty: there is none
    const PackedScene* scene = nullptr; ///< to begin with; null: the page's own
};
/// The whole page. Throws InputError for a page without its place for the solver.
std::string live_page(const LivePageDesc& desc);

} // namespace mane
