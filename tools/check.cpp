#include "commands.h"

#include "mane/cache.h"
#include "mane/check.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace mane::tool {
namespace {

using Json = nlohmann::ordered_json;

const char* name(Verdict verdict) {
    switch (verdict) {
    case Verdict::pass:
        return "pass";
    case Verdict::fail:
        return "FAIL";
    case Verdict::not_judged:
        break;
    }
    return "not judged";
}

std::string describe(const Offender& worst) {
    std::string text = fmt::format("frame {}", worst.frame);
    if (worst.point)
        text = fmt::format("point {}, {}", *worst.point, text);
    if (worst.section)
        text = fmt::format("section {}, {}", *worst.section, text);
    if (worst.wisp)
        text = fmt::format("wisp {}, {}", *worst.wisp, text);
    return text;
}

std::string quantity(double value, const std::string& unit) {
    return fmt::format("{:.4g}{}", value, unit == "1" ? "" : " " + unit);
}

void print_text(const CheckReport& report) {
    fmt::print("{:20} {:>14} {:>16}  {:10}  {:42}  {}\n", "criterion", "value", "bound", "verdict",
               "worst", "meaning");
    for (const Criterion& c : report.criteria) {
        const bool judged = c.verdict != Verdict::not_judged;
        const char* sense = c.sense == Sense::at_most ? "≤" : "≥";
        fmt::print("{:20} {:>14} {:>16}  {:10}  {:42}  {}{}\n", c.name,
                   judged || !std::isnan(c.value) ? quantity(c.value, c.unit) : "",
                   judged ? fmt::format("{} {}", sense, quantity(c.bound, c.unit)) : "",
                   name(c.verdict), c.worst ? describe(*c.worst) : "", c.meaning,
                   c.note.empty() ? "" : " (" + c.note + ")");
    }
    const auto failed = std::ranges::count(report.criteria, Verdict::fail, &Criterion::verdict);
    fmt::print("\n{}\n", failed == 0 ? "pass"
                                     : fmt::format("FAIL: {} of {} criteria", failed,
                                                   report.criteria.size()));
}

Json describe(const Criterion& c) {
    Json worst;
    if (c.worst) {
        worst = Json::object();
        if (c.worst->wisp)
            worst["wisp"] = *c.worst->wisp;
        if (c.worst->section)
            worst["section"] = *c.worst->section;
        if (c.worst->point)
            worst["point"] = *c.worst->point;
        worst["frame"] = c.worst->frame;
    }
    const bool judged = c.verdict != Verdict::not_judged;
    return {{"name", c.name},
            {"meaning", c.meaning},
            {"unit", c.unit},
            {"value", judged || !std::isnan(c.value) ? Json(c.value) : Json()},
            {"bound", judged ? Json(c.bound) : Json()},
            {"sense", c.sense == Sense::at_most ? "at most" : "at least"},
            {"verdict", c.verdict == Verdict::fail ? "fail" : name(c.verdict)},
            {"worst", worst},
            {"note", c.note}};
}

void print_json(const CheckReport& report) {
    Json criteria = Json::array();
    for (const Criterion& c : report.criteria)
        criteria.push_back(describe(c));
    fmt::print("{}\n", Json{{"passed", report.passed()}, {"criteria", criteria}}.dump(2));
}

} // namespace

int check(const CheckOptions& options) {
    const CheckReport report = check_run(CacheReader(options.file));
    if (options.json)
        print_json(report);
    else
        print_text(report);
    return report.passed() ? 0 : kFailed;
}

} // namespace mane::tool
