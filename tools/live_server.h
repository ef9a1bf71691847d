#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mane::tool {

/// A file as a server gives it.
struct ServedFile {
    std::string path; ///< from /
    std::string_view bytes;
    const char* type; ///< MIME
};

/// The headers that isolate a page, without which a browser lets no threads share memory.
struct Header {
    const char *name, *value;
};
constexpr Header kIsolation[] = {{"Cross-Origin-Opener-Policy", "same-origin"},
                                 {"Cross-Origin-Embedder-Policy", "require-corp"}};

/// Serves files to this machine alone until a signal ends it. Calls `ready` with the address.
/// Throws InputError for a port that is taken, and where `mane` was built without a server.
void serve(const std::vector<ServedFile>& files, int port,
           void (*ready)(const std::string& address));

} // namespace mane::tool
