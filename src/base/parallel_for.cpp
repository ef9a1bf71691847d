#include "base/parallel_for.h"

#if !defined(__EMSCRIPTEN__) || defined(__EMSCRIPTEN_PTHREADS__)
#define MANE_HAS_THREADS 1
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#else
#define MANE_HAS_THREADS 0
#endif

namespace mane {

#if MANE_HAS_THREADS

// Our own pool, not oneTBB: the page and the wheel need it without system libraries, and
// ThreadSanitizer sees through it.
struct Threads::Pool {
    explicit Pool(unsigned workers) {
        for (unsigned i = 0; i < workers; ++i)
            threads.emplace_back([this] { work(); });
    }
    ~Pool() {
        {
            std::lock_guard lock(mutex);
            stop = true;
        }
        wake.notify_all();
        for (std::thread& t : threads)
            t.join();
    }

    void run(std::size_t chunk_count, const std::function<void(std::size_t)>& loop) {
        {
            std::lock_guard lock(mutex);
            body = &loop;
            chunks = chunk_count;
            next.store(0, std::memory_order_relaxed);
            failed_chunk = chunk_count;
            failure = nullptr;
            active = threads.size();
            ++round;
        }
        wake.notify_all();
        take_chunks();
        std::unique_lock lock(mutex);
        done.wait(lock, [this] { return active == 0; });
        if (failure)
            std::rethrow_exception(failure);
    }

    void work() {
        std::size_t seen = 0;
        for (;;) {
            {
                std::unique_lock lock(mutex);
                wake.wait(lock, [&] { return stop || round != seen; });
                if (stop)
                    return;
                seen = round;
            }
            take_chunks();
            std::lock_guard lock(mutex);
            if (--active == 0)
                done.notify_one();
        }
    }

    void take_chunks() {
        for (;;) {
            const std::size_t c = next.fetch_add(1, std::memory_order_relaxed);
            if (c >= chunks)
                return;
            try {
                (*body)(c);
            } catch (...) {
                std::lock_guard lock(mutex);
                if (c < failed_chunk) {
                    failed_chunk = c;
                    failure = std::current_exception();
                }
            }
        }
    }

    std::vector<std::thread> threads;
    std::mutex mutex;
    std::condition_variable wake, done;
    const std::function<void(std::size_t)>* body = nullptr;
    std::size_t chunks = 0, failed_chunk = 0, active = 0, round = 0;
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    bool stop = false;
};

Threads::Threads(unsigned count)
    : count_(count ? count : std::max(1u, std::thread::hardware_concurrency())) {
    if (count_ > 1)
        pool_ = std::make_unique<Pool>(count_ - 1);
}

#else

struct Threads::Pool {
    void run(std::size_t, const std::function<void(std::size_t)>&) {}
};
Threads::Threads(unsigned) : count_(1) {}

#endif

Threads::~Threads() = default;

void Threads::run(std::size_t chunks, const std::function<void(std::size_t)>& body) {
    if (pool_ && chunks > 1) {
        pool_->run(chunks, body);
        return;
    }
    for (std::size_t c = 0; c < chunks; ++c)
        body(c);
}

} // namespace mane
