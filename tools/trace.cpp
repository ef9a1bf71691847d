#include "trace.h"

#include <fmt/core.h>

#include <system_error>

namespace mane::tool {
namespace {

// The names of the whole, and the one row that all events are on: they nest by their times.
constexpr const char* kHead =
    R"({"displayTimeUnit":"ms","traceEvents":[
{"ph":"M","pid":1,"tid":1,"name":"process_name","args":{"name":"mane"}},
{"ph":"M","pid":1,"tid":1,"name":"thread_name","args":{"name":"simulate"}})";
constexpr const char* kTail = "\n]}\n";

/// [µs] with all digits of the clock, so that sums are exact.
std::string microseconds(std::chrono::steady_clock::duration d) {
    const auto n = std::chrono::duration_cast<std::chrono::nanoseconds>(d).count();
    return fmt::format("{}.{:03}", n / 1000, n % 1000);
}

} // namespace

Trace::Trace(std::filesystem::path file) : file_(std::move(file)), part_(file_) {
    std::error_code ignored;
    if (!std::filesystem::exists(file_, ignored) ||
        std::filesystem::is_regular_file(file_, ignored))
        part_ += ".part";
    out_.open(part_, std::ios::binary);
    out_ << kHead;
    if (!out_)
        throw InputError(file_.string() + ": cannot be written");
}

Trace::~Trace() {
    std::error_code ignored;
    if (!finished_ && part_ != file_)
        std::filesystem::remove(part_, ignored);
}

void Trace::add(const StageSpan& span) noexcept {
    add(stage_name(span.stage), "stage", span.begin, span.end);
}

void Trace::add_frame(std::int64_t frame, Time begin, Time end) {
    add("frame", "frame", begin, end, fmt::format(R"(,"args":{{"frame":{}}})", frame));
}

void Trace::add_writing(Time begin, Time end) {
    add("writing", "frame", begin, end);
}

void Trace::add(const char* name, const char* category, Time begin, Time end,
                const std::string& more) {
    out_ << fmt::format(",\n"
                        R"({{"ph":"X","pid":1,"tid":1,"name":"{}","cat":"{}","ts":{},"dur":{}{}}})",
                        name, category, microseconds(begin - start_), microseconds(end - begin),
                        more);
}

void Trace::finish() {
    out_ << kTail;
    out_.close();
    std::error_code error;
    if (out_ && part_ != file_)
        std::filesystem::rename(part_, file_, error);
    if (!out_ || error)
        throw InputError(file_.string() + ": cannot be written");
    finished_ = true;
}

} // namespace mane::tool
