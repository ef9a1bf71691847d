// A signal lets the frame in work be finished; a later one does not wait for it.
#include "interrupt.h"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

using mane::tool::Interrupt;

TEST_CASE("a signal that timeout(1) sends twice is one request") {
    const Interrupt interrupt;
    CHECK(interrupt.signal() == 0);
    std::raise(SIGTERM);
    std::raise(SIGTERM);
    CHECK(interrupt.signal() == SIGTERM);
}

TEST_CASE("a signal two seconds after the first ends the program at once") {
    const pid_t child = fork();
    if (child == 0) {
        const Interrupt interrupt;
        std::raise(SIGINT);
        sleep(2);
        std::raise(SIGINT);
        _exit(0);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(WIFSIGNALED(status));
    CHECK(WTERMSIG(status) == SIGINT);
}
