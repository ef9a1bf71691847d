#include "interrupt.h"

#include <csignal>

namespace mane::tool {
namespace {

volatile std::sig_atomic_t received = 0;

extern "C" void note_signal(int number) {
    received = number;
    std::signal(number, SIG_DFL);
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
