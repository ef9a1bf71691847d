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

/// How often a thread looks before it sleeps: some ten microseconds, longer than the stages of a
/// step are apart. To be woken takes about as long as a stage of a thousand wisps.
constexpr int kLooks = 400;

void look_again_soon() {
#if defined(__SSE2__)
    __builtin_ia32_pause();
#else
    std::this_thread::yield();
#endif
}

// Our own pool, not oneTBB: the page and the wheel need it without system libraries, and
// ThreadSanitizer sees through it.
struct Threads::Pool {
    explicit Pool(unsigned workers) {
        for (unsigned i = 0; i <= workers; ++i)
            shares.push_back(std::make_unique<Share>());
        for (unsigned i = 0; i < workers; ++i)
            threads.emplace_back([this, i] { work(i + 1); });
    }
    ~Pool() {
        stop.store(true);
        announce();
        for (std::thread& t : threads)
            t.join();
    }

    void run(std::size_t chunk_count, const std::function<void(std::size_t)>& loop) {
        body = &loop;
        for (std::size_t s = 0; s < shares.size(); ++s) {
            shares[s]->next.store(s * chunk_count / shares.size(), std::memory_order_relaxed);
            shares[s]->end = (s + 1) * chunk_count / shares.size();
        }
        failed_chunk = chunk_count;
        failure = nullptr;
        open.store(true);
        announce();
        take_chunks(0);
        open.store(false); // who has not come by now finds nothing to do; nobody waits for sleepers
        wait_for(done, [this] { return inside.load() == 0; });
        if (failure)
            std::rethrow_exception(failure);
    }

    /// A new round, to those who look and to those who sleep.
    void announce() {
        {
            const std::lock_guard lock(mutex);
            round.fetch_add(1);
        }
        wake.notify_all();
    }

    template <typename Condition>
    void wait_for(std::condition_variable& news, const Condition& condition) {
        for (int look = 0; look < kLooks; ++look) {
            if (condition())
                return;
            look_again_soon();
        }
        std::unique_lock lock(mutex);
        news.wait(lock, condition);
    }

    void work(std::size_t thread) {
        std::size_t seen = 0;
        for (;;) {
            wait_for(wake, [&] { return round.load() != seen; });
            seen = round.load();
            if (stop.load())
                return;
            // Inside before it looks whether the loop is open, so either it sees that it is not, or
            // who closes it sees that someone is inside.
            inside.fetch_add(1);
            if (open.load())
                take_chunks(thread);
            if (inside.fetch_sub(1) == 1) {
                { const std::lock_guard lock(mutex); } // who waits has looked, or sleeps by now
                done.notify_one();
            }
        }
    }

    /// First those of a thread's own share, so that it meets the data again that it wrote in the
    /// loop before; then what is left of the others'.
    void take_chunks(std::size_t thread) {
        for (std::size_t i = 0; i < shares.size(); ++i)
            take_share(*shares[(thread + i) % shares.size()]);
    }

    struct Share {
        alignas(64) std::atomic<std::size_t> next{0};
        std::size_t end = 0;
    };
    void take_share(Share& share) {
        for (;;) {
            const std::size_t c = share.next.fetch_add(1, std::memory_order_relaxed);
            if (c >= share.end)
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

    std::vector<std::unique_ptr<Share>> shares;
    std::vector<std::thread> threads;
    std::mutex mutex;
    std::condition_variable wake, done;
    const std::function<void(std::size_t)>* body = nullptr;
    std::size_t failed_chunk = 0;
    std::atomic<std::size_t> inside{0}, round{0};
    std::atomic<bool> open{false}, stop{false};
    std::exception_ptr failure;
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
