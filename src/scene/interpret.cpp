#include "mane/fields.h"

#include "mane/error.h"
#include "scene/number.h"
#include "scene/units.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mane {
namespace {

std::string show(const Literal& literal) {
    struct Show {
        std::string operator()(bool b) const { return b ? "true" : "false"; }
        std::string operator()(std::int64_t i) const { return std::to_string(i); }
        std::string operator()(double x) const { return shortest(x); }
        std::string operator()(const std::string& s) const { return '"' + s + '"'; }
        std::string operator()(const std::vector<Literal>& list) const {
            std::string text = "[";
            for (const Literal& item : list)
                text += (text.size() > 1 ? ", " : "") + show(item);
            return text + "]";
        }
    };
    return std::visit(Show{}, literal.value);
}

/// Everything that can be wrong with a value ends here.
struct Reader {
    const FieldInfo& field;
    const Literal& literal;
    const std::string& where;

    [[noreturn]] void fail(const std::string& reason = {}) const {
        throw InputError(where + ": " + field.key() + ": found " + show(literal) + ", expected " +
                         expectation(field) + (reason.empty() ? "" : ": " + reason));
    }

    double quantity(const std::string& text) const {
        const std::size_t end = std::min(text.find_first_not_of("+-.0123456789eE"), text.size());
        double x = 0;
        if (!parse_real(text.substr(0, end), x))
            fail();
        const std::string unit =
            text.substr(std::min(text.find_first_not_of(' ', end), text.size()));
        const std::optional<double> factor = unit_factor(unit, field.unit);
        if (!factor)
            fail("\"" + unit + "\" is no unit for [" + std::string(field.unit) + "]");
        return x * *factor;
    }

    double real(const Literal& item) const {
        double x = 0;
        if (const auto* i = std::get_if<std::int64_t>(&item.value))
            x = static_cast<double>(*i);
        else if (const auto* d = std::get_if<double>(&item.value))
            x = *d;
        else if (const auto* s = std::get_if<std::string>(&item.value))
            x = quantity(*s);
        else
            fail();
        if (!std::isfinite(x) || x < field.range.low || x > field.range.high)
            fail();
        return x;
    }

    /// Exactly `n` numbers.
    const std::vector<Literal>& list(std::size_t n) const {
        const auto* items = std::get_if<std::vector<Literal>>(&literal.value);
        if (!items || items->size() != n)
            fail();
        return *items;
    }

    Value operator()(bool) const {
        const bool* b = std::get_if<bool>(&literal.value);
        if (!b)
            fail();
        return *b;
    }
    Value operator()(std::uint32_t) const {
        const double x = real(literal);
        if (x != std::floor(x))
            fail();
        return static_cast<std::uint32_t>(x);
    }
    Value operator()(float) const { return static_cast<float>(real(literal)); }
    Value operator()(double) const { return real(literal); }
    Value operator()(const Ramp&) const {
        if (!std::holds_alternative<std::vector<Literal>>(literal.value))
            return Ramp(static_cast<float>(real(literal)));
        const auto& items = list(2);
        return Ramp(static_cast<float>(real(items[0])), static_cast<float>(real(items[1])));
    }
    Value operator()(const Vec3&) const {
        const auto& items = list(3);
        return Vec3(static_cast<float>(real(items[0])), static_cast<float>(real(items[1])),
                    static_cast<float>(real(items[2])));
    }
    Value operator()(const std::string&) const {
        const std::string* s = std::get_if<std::string>(&literal.value);
        if (!s)
            fail();
        if (field.choices.empty() ||
            std::find(field.choices.begin(), field.choices.end(), *s) != field.choices.end())
            return *s;
        fail();
    }
};

std::string limits(const FieldInfo& field) {
    const bool low = std::isfinite(field.range.low), high = std::isfinite(field.range.high);
    std::string text;
    if (low && high)
        text = " from " + shortest(field.range.low) + " to " + shortest(field.range.high);
    else if (low)
        text = " of at least " + shortest(field.range.low);
    else if (high)
        text = " of at most " + shortest(field.range.high);
    return field.unit.empty() || field.unit == "1" ? text
                                                   : text + " [" + std::string(field.unit) + "]";
}

} // namespace

Value interpret(const FieldInfo& field, const Literal& literal, const std::string& where) {
    return std::visit(Reader{field, literal, where}, field.standard);
}

std::string expectation(const FieldInfo& field) {
    struct Describe {
        const FieldInfo& field;
        std::string operator()(bool) const { return "true or false"; }
        std::string operator()(std::uint32_t) const { return "a whole number" + limits(field); }
        std::string operator()(float) const { return "a number" + limits(field); }
        std::string operator()(double) const { return "a number" + limits(field); }
        std::string operator()(const Ramp&) const {
            return "a number or [root, tip]" + limits(field);
        }
        std::string operator()(const Vec3&) const { return "[x, y, z], each" + limits(field); }
        std::string operator()(const std::string&) const {
            if (field.choices.empty())
                return has(field.use, FieldUse::path) ? "a file name in quotes" : "text in quotes";
            std::string text = "one of";
            for (std::size_t i = 0; i < field.choices.size(); ++i)
                text += (i ? ", \"" : " \"") + std::string(field.choices[i]) + '"';
            return text;
        }
    };
    return std::visit(Describe{field}, field.standard);
}

} // namespace mane
