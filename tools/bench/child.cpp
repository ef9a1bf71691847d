#include "bench/child.h"

#include "mane/error.h"

#include <fmt/core.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <stdexcept>

extern char** environ;

namespace mane::bench {
namespace {

std::string this_program() {
#ifdef __linux__
    return std::filesystem::read_symlink("/proc/self/exe").string();
#else
    return "mane"; // from the PATH
#endif
}

/// A process whose standard output comes to us.
class Child {
  public:
    Child(std::string program, std::string argument) {
        std::array<int, 2> ends{};
        if (pipe(ends.data()) != 0)
            throw std::runtime_error("no pipe for a run of the benchmark");
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
        for (const int end : ends)
            posix_spawn_file_actions_addclose(&actions, end);
        std::string command = "bench-one";
        std::array<char*, 4> arguments{program.data(), command.data(), argument.data(), nullptr};
        const int error =
            posix_spawnp(&process_, program.c_str(), &actions, nullptr, arguments.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        close(ends[1]);
        out_ = ends[0];
        if (error != 0) {
            close(out_);
            throw InputError(program + ": cannot be started");
        }
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        close(out_);
        if (running_)
            kill(process_, SIGKILL), wait();
    }

    /// All that it writes until it closes its output; less when a signal comes, which it is told.
    std::string read(const tool::Interrupt& interrupt) {
        std::string text;
        std::array<char, 4096> piece;
        for (;;) {
            pollfd ready{out_, POLLIN, 0};
            if (poll(&ready, 1, 100) > 0) {
                const ssize_t n = ::read(out_, piece.data(), piece.size());
                if (n <= 0)
                    return text;
                text.append(piece.data(), static_cast<std::size_t>(n));
            }
            if (interrupt.signal()) {
                kill(process_, interrupt.signal());
                return text;
            }
        }
    }

    /// How it ended, as a shell says it.
    int wait() {
        int status = 0;
        waitpid(process_, &status, 0);
        running_ = false;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

  private:
    pid_t process_ = 0;
    int out_ = -1;
    bool running_ = true;
};

} // namespace

std::optional<Json> run_in_child(const Case& c, const tool::Interrupt& interrupt) {
    Child child(c.program.empty() ? this_program() : c.program, to_json(c).dump());
    const std::string text = child.read(interrupt);
    const int code = child.wait();
    if (interrupt.signal())
        return std::nullopt;
    const Json answer = Json::parse(text, nullptr, false);
    if (code == 0 && answer.is_object())
        return answer;
    const std::string why = answer.is_string() ? answer.get<std::string>()
                                               : fmt::format("the run ended with code {}", code);
    if (code == tool::kBadInput)
        throw InputError(c.name + ": " + why);
    throw std::runtime_error(c.name + ": " + why);
}

} // namespace mane::bench
