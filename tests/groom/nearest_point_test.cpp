#include "groom/nearest_point.h"

#include "base/random.h"

#include <doctest/doctest.h>

using namespace mane;

namespace {

Vec3d random_vec(const Random& random, std::uint64_t i, float size) {
    return {random.between(3 * i, -size, size), random.between(3 * i + 1, -size, size),
            random.between(3 * i + 2, -size, size)};
}

} // namespace

TEST_CASE("the nearest of points in cells is the one that looking at all finds") {
    for (std::size_t count : {1, 2, 3, 17, 400, 3000})
        for (const Vec3d flat : {Vec3d{1, 1, 1}, Vec3d{1, 0, 0.3}, Vec3d{0, 0, 1}}) {
            const Random random(count, 5);
            std::vector<Vec3d> points;
            for (std::size_t i = 0; i < count; ++i) {
                const Vec3d p = random_vec(random, i, 1);
                points.push_back({p.x * flat.x, p.y * flat.y, p.z * flat.z});
            }
            points.push_back(points.front()); // a tie: the first counts
            const NearestPoint nearest(points);
            for (std::size_t q = 0; q < 300; ++q) {
                const Vec3d p = q < count ? points[q] : random_vec(random, 10'000 + q, 3);
                std::size_t best = 0;
                for (std::size_t i = 1; i < points.size(); ++i)
                    if (dot(points[i] - p, points[i] - p) < dot(points[best] - p, points[best] - p))
                        best = i;
                CHECK(nearest(p) == best);
            }
        }
}
