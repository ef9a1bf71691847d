#include "interrupt.h"

#include <atomic>
#include <csignal>
#include <ctime>

namespace mane::tool {
namespace {

/// timeout(1) and some shells send their signal twice, to the program and to its group.
constexpr std::time_t kSameRequest = 1; // seconds

std::atomic<int> received = 0;
std::atomic<std::time_t> received_at = 0;

std::time_t seconds_since_boot() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now); // one of the few calls that a handler may make
    return now.tv_sec;
}

extern "C" void note_signal(int number) {
    const std::time_t now = seconds_since_boot();
    if (received && now - received_at > kSameRequest) {
        std::signal(number, SIG_DFL);
        std::raise(number);
        return;
    }
    if (!received)
        received_at = now;
    received = number;
}

} // namespace

Interrupt::Interrupt() {
    received = 0;
    std::signal(SIGINT, note_signal);
    std::signal(SIGTERM, note_signal);
}

Interrupt::~Interrupt() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

int Interrupt::signal() const {
    return received;
}

} // namespace mane::tool
