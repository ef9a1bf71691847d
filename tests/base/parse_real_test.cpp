#include "base/parse_real.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

using namespace mane;

TEST_CASE("a whole text is a number or none") {
    double x = 0;
    for (const char* text : {"", "+", "-", ".", "e5", "1e", "1 ", " 1", "1,5", "0x10", "--1", "+-1",
                             "-+1", "1.2.3", "6 cm", "1e999"}) {
        CAPTURE(text);
        CHECK_FALSE(parse_real(text, x));
    }
    for (const char* text : {"7", "+7", "7.", "7.0", "70e-1", "0.7E1", "+.7e+1"}) {
        CAPTURE(text);
        CHECK(parse_real(text, x));
        CHECK(x == 7);
    }
    CHECK(parse_real("-inf", x));
    CHECK(x < -1e308);
    CHECK(parse_real("nan", x));
    CHECK(std::isnan(x));
}

TEST_CASE("a number is rounded once, to its own type") {
    double x = 0;
    CHECK(parse_real("9007199254740993", x)); // halfway: to even
    CHECK(x == 9007199254740992.0);
    CHECK(parse_real("2.2250738585072011e-308", x));
    CHECK(x == 0x0.fffffffffffffp-1022);
    // By way of a double, this would be rounded twice.
    float f = 0;
    CHECK(parse_real("1.000000059604644775390625", f)); // halfway: to even
    CHECK(f == 1.0f);
    CHECK(parse_real("1.00000005960464477539062500000001", f));
    CHECK(f == 1.00000011920928955078125f);
}
