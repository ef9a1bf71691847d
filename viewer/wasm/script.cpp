// The page's session without a page: does what a script says, line by line, and prints the state's
// hash where it asks for it. Tests do the same in a browser and expect the same hashes (M39).
//   live_script SCENE.toml SCRIPT

#include "session.h"

#include "mane/error.h"

#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>

namespace {

using namespace mane;
using namespace mane::page;

std::string read(const char* path) {
    std::ifstream in(path, std::ios::binary);
    if (!in)
        throw InputError(std::string(path) + ": cannot be read");
    return {std::istreambuf_iterator<char>(in), {}};
}

void obey(Session& session, const std::string& line) {
    std::istringstream words(line);
    std::string what;
    words >> what;
    const auto number = [&] {
        double x = 0;
        if (!(words >> x))
            throw InputError("\"" + line + "\": a number is missing");
        return x;
    };
    const auto point = [&] {
        const double x = number(), y = number();
        return Vec3d(x, y, number());
    };
    if (what == "set") {
        std::string setting;
        std::getline(words >> std::ws, setting);
        session.set(setting);
    } else if (what == "rates") {
        std::string preset;
        words >> preset;
        session.set_rates(preset);
    } else if (what == "hold") {
        Hold hold;
        hold.position = point();
        hold.turn = {number(), number(), number()};
        session.hold(hold);
    } else if (what == "teleport") {
        session.teleport(point());
    } else if (what == "pin") {
        const auto section = static_cast<std::uint32_t>(number());
        session.pin(section, point());
    } else if (what == "release") {
        session.release(static_cast<std::uint32_t>(number()));
    } else if (what == "restart") {
        session.restart();
    } else if (what == "advance") {
        for (double i = number(); i > 0; --i)
            session.advance();
    } else if (what == "hash") {
        std::printf("%016" PRIx64 "\n", session.world().state_hash());
    } else {
        throw InputError("\"" + line + "\": unknown");
    }
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 3)
        return std::fprintf(stderr, "usage: live_script SCENE.toml SCRIPT\n"), 2;
    try {
        Session session(1);
        session.open(read(argv[1]), argv[1]);
        std::istringstream script(read(argv[2]));
        for (std::string line; std::getline(script, line);)
            if (!line.empty() && line[0] != '#')
                obey(session, line);
        return 0;
    } catch (const std::exception& error) {
        return std::fprintf(stderr, "%s\n", error.what()), 1;
    }
}
