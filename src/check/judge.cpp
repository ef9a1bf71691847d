#include "check/judge.h"

namespace mane::judge {
namespace {

Criterion asked(const Question& q) {
    Criterion c;
    c.name = q.name;
    c.meaning = q.meaning;
    c.unit = q.unit;
    c.bound = q.bound;
    c.sense = q.sense;
    return c;
}

} // namespace

Offender offender(const Groom& groom, std::size_t section, std::uint32_t frame) {
    const std::uint32_t wisp = wisp_of(groom, section);
    return {wisp, static_cast<std::uint32_t>(section) - groom.first_section[wisp], {}, frame};
}

Criterion answered(const Question& question, double value, std::optional<Offender> worst,
                   std::string note) {
    Criterion c = asked(question);
    c.value = value;
    const bool good = c.sense == Sense::at_most ? value <= c.bound : value >= c.bound;
    c.verdict = good ? Verdict::pass : Verdict::fail;
    c.worst = worst;
    c.note = std::move(note);
    return c;
}

Criterion unanswered(const Question& question, std::string why) {
    Criterion c = asked(question);
    c.note = std::move(why);
    return c;
}

Criterion measured(const char* name, const char* meaning, const char* unit, double value,
                   std::string note) {
    Criterion c = unanswered({name, meaning, unit, 0}, std::move(note));
    c.value = value;
    return c;
}

} // namespace mane::judge
