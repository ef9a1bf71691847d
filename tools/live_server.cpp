// The only file that sees cpp-httplib.
#include "live_server.h"

#include "mane/error.h"

#ifdef MANE_HAS_SERVER
#include "interrupt.h"

#include <httplib.h>

#include <chrono>
#include <thread>
#endif

namespace mane::tool {

#ifdef MANE_HAS_SERVER

void serve(const std::vector<ServedFile>& files, int port,
           void (*ready)(const std::string& address)) {
    constexpr const char* kHost = "127.0.0.1"; // nobody else's business
    httplib::Server server;
    for (const ServedFile& file : files)
        server.Get(file.path, [&file](const httplib::Request&, httplib::Response& response) {
            for (const Header& header : kIsolation)
                response.set_header(header.name, header.value);
            response.set_header("Cache-Control", "no-store");
            response.set_content(file.bytes.data(), file.bytes.size(), file.type);
        });
    if (port == 0)
        port = server.bind_to_any_port(kHost);
    else if (!server.bind_to_port(kHost, port))
        port = -1;
    if (port < 0)
        throw InputError("the port is taken; --port 0 finds a free one");
    const Interrupt interrupt;
    std::thread listener([&] { server.listen_after_bind(); });
    ready("http://" + std::string(kHost) + ":" + std::to_string(port) + "/");
    while (!interrupt.signal())
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    server.stop();
    listener.join();
}

#else

void serve(const std::vector<ServedFile>&, int, void (*)(const std::string&)) {
    throw InputError(
        "this mane was built without a server: install libcpp-httplib-dev and build it "
        "again, or write a folder with -o and serve that");
}

#endif

} // namespace mane::tool
