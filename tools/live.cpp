#include "commands.h"

#include "base/whole_file.h"
#include "live_server.h"
#include "mane/error.h"
#include "mane/live_page.h"
#include "pages.h"

#include <fmt/core.h>

#include <cstdio>
#include <filesystem>
#include <optional>

namespace mane::tool {
namespace {

constexpr const char* kThreadsScript = "solver_threads.js";

void write(const std::filesystem::path& path, std::string_view bytes) {
    WholeFile file(path);
    file.write(bytes);
    file.finish();
}

/// Of a folder or a server: the page, and beside it the solver with threads.
std::vector<ServedFile> served_files(std::string_view page, const LiveFiles& live) {
    return {{"/", page, "text/html; charset=utf-8"},
            {std::string("/") + kThreadsScript, live.threads_script, "text/javascript"},
            {"/solver_threads.worker.js", live.threads_worker, "text/javascript"},
            {"/solver_threads.wasm", live.threads_module, "application/wasm"}};
}

/// What a server has to be told, in the words of two kinds of them.
std::string isolation_note() {
    std::string note = "This folder is the live page for any web server. It runs as it is, on one "
                       "thread. With these two\n"
                       "headers on all its files a browser lets it use several:\n\n";
    for (const Header& header : kIsolation)
        note += fmt::format("{}: {}\n", header.name, header.value);
    note += "\nnginx:\n";
    for (const Header& header : kIsolation)
        note += fmt::format("    add_header {} {};\n", header.name, header.value);
    note += "Apache:\n";
    for (const Header& header : kIsolation)
        note += fmt::format("    Header set {} \"{}\"\n", header.name, header.value);
    return note + "Hosts of static pages that read a file _headers find them there.\n";
}

void write_folder(const std::filesystem::path& folder, const std::vector<ServedFile>& files) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw InputError("cannot make " + folder.string() + ": " + error.message());
    for (const ServedFile& file : files)
        write(folder / (file.path == "/" ? "index.html" : file.path.substr(1)), file.bytes);
    std::string headers = "/*\n";
    for (const Header& header : kIsolation)
        headers += fmt::format("  {}: {}\n", header.name, header.value);
    write(folder / "_headers", headers);
    write(folder / "README.txt", isolation_note());
}

} // namespace

int live(const LiveOptions& options) {
    if (options.output.empty() != options.serve)
        throw InputError("expected either -o PAGE.html, -o FOLDER/ or --serve");
    if (options.scene.empty() && !(options.settings.empty() && options.rates.empty()))
        throw InputError("--set and --rates change a scene: expected one");
    const LiveFiles files = live_files();
    std::optional<PackedScene> scene;
    if (!options.scene.empty())
        scene = pack_scene(options.scene, options.settings, options.rates);
    const bool alone = !options.serve && !options.output.ends_with('/');
    const std::string page = live_page({files.page, files.script, files.module,
                                        alone ? "" : kThreadsScript, scene ? &*scene : nullptr});
    if (alone)
        write(options.output, page);
    else if (options.serve)
        serve(served_files(page, files), options.port, [](const std::string& address) {
            fmt::print("{}   (Ctrl+C ends it)\n", address);
            std::fflush(stdout);
        });
    else
        write_folder(options.output, served_files(page, files));
    return 0;
}

} // namespace mane::tool
