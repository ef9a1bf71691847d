#include "character/low_pass.h"
#include "character/rotation.h"
#include "character/track.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace mane;

namespace {

const double kTurn = 2 * 3.14159265358979323846;

// The value's k-th derivative from both sides of a time, by one-sided differences of the rate
// (exact for the quintics inside).
double acceleration_beside(const Track<3>& track, double time, double side) {
    const double h = 1e-4 * side;
    const double r0 = track.evaluate(time).rate[0], r1 = track.evaluate(time + h).rate[0],
                 r2 = track.evaluate(time + 2 * h).rate[0];
    return (-1.5 * r0 + 2 * r1 - 0.5 * r2) / h;
}

Track<3> wild_track(TrackEnd end) {
    return {{0, 0.3, 0.4, 1.1, 1.5, 2.0},
            {{0, 1, 2}, {1, 1, 0}, {-1, 0, 0}, {2, 2, 2}, {2.5, 0, 1}, {0, 0, 0}},
            end};
}

} // namespace

TEST_CASE("a track passes through its keys and is C² at every one, and at rest outside") {
    for (TrackEnd end : {TrackEnd::rest, TrackEnd::coast}) {
        const Track<3> track = wild_track(end);
        CHECK(track.evaluate(0.4).value[0] == doctest::Approx(-1));
        CHECK(track.evaluate(1.5).value[0] == doctest::Approx(2.5));
        for (double time : {-0.5, 0.0, 0.3, 0.4, 1.1, 1.5, 2.0, 2.5}) {
            CAPTURE(time);
            const double e = 1e-9;
            CHECK(std::fabs(track.evaluate(time + e).value[0] - track.evaluate(time - e).value[0]) <
                  1e-7);
            CHECK(std::fabs(track.evaluate(time + e).rate[0] - track.evaluate(time - e).rate[0]) <
                  1e-5);
            // accelerations are up to 500 here; one-sided differences of second order leave h²
            // times the third derivative of the rate
            CHECK(std::fabs(acceleration_beside(track, time, 1) -
                            acceleration_beside(track, time, -1)) < 0.01);
        }
        CHECK(track.evaluate(-0.6).rate[0] == 0);
        CHECK(track.evaluate(2.6).rate[0] == 0);
        CHECK(track.evaluate(1e9).value == track.evaluate(3).value);
    }
    CHECK(wild_track(TrackEnd::rest).evaluate(5).value[0] == 0);
    CHECK(wild_track(TrackEnd::rest).evaluate(0).rate[0] == 0);
}

TEST_CASE(
    "a track's rate is the derivative of its value: central differences converge with order 2") {
    const Track<3> track = wild_track(TrackEnd::coast);
    for (double time : {-0.3, 0.17, 0.35, 0.7, 1.2, 1.8, 2.2}) {
        const auto error = [&](double h) {
            return std::fabs(
                (track.evaluate(time + h).value[1] - track.evaluate(time - h).value[1]) / (2 * h) -
                track.evaluate(time).rate[1]);
        };
        CHECK(error(1e-3) < 1e-3);
        CHECK(error(1e-3) < 0.3 * error(2e-3) + 1e-10); // a quarter, but for rounding
    }
}

TEST_CASE("a coasting track keeps the velocity that it has at its ends") {
    const Track<3> track({1, 2, 3}, {{0, 0, 0}, {4, 0, 0}, {8, 0, 0}}, TrackEnd::coast);
    CHECK(track.evaluate(1).rate[0] == doctest::Approx(4));
    CHECK(track.evaluate(3).rate[0] == doctest::Approx(4));
    CHECK(track.evaluate(9).value[0] == doctest::Approx(8 + 4 * Track<3>::kCoastTime / 2));
    const Track<3> still({5}, {{7, 8, 9}}, TrackEnd::coast);
    CHECK(still.evaluate(5.1).value[2] == 9);
    CHECK(still.evaluate(5.1).rate[2] == 0);
}

TEST_CASE("a spline through a smooth curve errs with the fourth order of the knots' distance") {
    const auto error = [](int keys) {
        std::vector<double> times;
        std::vector<std::array<double, 3>> values;
        for (int k = 0; k <= keys; ++k) {
            times.push_back(double(k) / keys);
            values.push_back(
                {std::sin(kTurn * times.back()), 0, 0}); // natural ends fit: no curvature there
        }
        const Track<3> track(times, values, TrackEnd::coast);
        double most = 0;
        for (int k = 0; k < 1000; ++k)
            most = std::max(most, std::fabs(track.evaluate(k / 1000.0).value[0] -
                                            std::sin(kTurn * k / 1000.0)));
        return most;
    };
    CHECK(error(20) / error(40) == doctest::Approx(16).epsilon(0.1));
}

TEST_CASE("the low-pass passes a sine at the cut-off with −3 dB, a slow one whole, and a straight "
          "line exactly") {
    const double rate = 120, cutoff = 20;
    const auto gain = [&](double frequency) {
        std::vector<std::array<double, 3>> x;
        for (int i = 0; i < 600; ++i) {
            const double phase = kTurn * frequency * i / rate;
            x.push_back({std::cos(phase), std::sin(phase), i * 0.25});
        }
        gaussian_low_pass(x, gaussian_width(cutoff, rate));
        CHECK(x[0][2] == doctest::Approx(0));
        CHECK(x[1][2] == doctest::Approx(0.25));
        CHECK(x[599][2] == doctest::Approx(599 * 0.25));
        const double most = std::hypot(x[300][0], x[300][1]);
        CHECK(std::hypot(x[301][0], x[301][1]) == doctest::Approx(most));
        return most;
    };
    // the gain of a Gaussian, exp(−ln 2/2 (f/f_c)²); sampling it adds under 3e-4 here
    for (double frequency : {0.5, 5.0, 10.0, 20.0, 30.0})
        CHECK(gain(frequency) ==
              doctest::Approx(std::exp(-0.34657359 * frequency * frequency / 400)).epsilon(3e-3));
    CHECK(gain(20) == doctest::Approx(std::sqrt(0.5)).epsilon(1e-3));
}

TEST_CASE("the low-pass makes do with fewer samples than its kernel") {
    std::vector<std::array<double, 3>> x{{1, 2, 3}, {2, 2, 3}};
    gaussian_low_pass(x, 4);
    CHECK(x[0][0] == doctest::Approx(1));
    CHECK(x[1][1] == doctest::Approx(2));
}

TEST_CASE("a turning's angular velocity is the derivative of its rotation, whatever the "
          "quaternion's length") {
    // q(t) = s(t) (axis sin ωt/2, cos ωt/2) with a changing length s
    const Vec3d axis = normalized(Vec3d(1, -2, 0.5));
    const double omega = 3, t = 0.4, length_now = 1.7, length_rate = -5;
    const double c = std::cos(omega * t / 2), s = std::sin(omega * t / 2), half = omega / 2;
    TrackPoint<4> point;
    const double unit[4] = {axis.x * s, axis.y * s, axis.z * s, c};
    const double rate[4] = {axis.x * c * half, axis.y * c * half, axis.z * c * half, -s * half};
    for (std::size_t k = 0; k < 4; ++k) {
        point.value[k] = length_now * unit[k];
        point.rate[k] = length_now * rate[k] + length_rate * unit[k];
    }
    const Turning turning = turning_of(point);
    CHECK(length(turning.angular_velocity - axis * omega) < 1e-12);
    CHECK(dot(turning.rotation, turning.rotation) == doctest::Approx(1));
}
