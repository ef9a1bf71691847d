#include "picture/ray_scene.h"

#include <limits>
#include <stdexcept>
#include <string>

namespace mane {
namespace {

struct CurvePoint {
    Vec3 position;
    float radius;
};

template <typename T> std::span<T> new_buffer(RTCGeometry geometry, RTCBufferType type,
                                              RTCFormat format, std::size_t count) {
    return {static_cast<T*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count)),
            count};
}

std::vector<Vec3> smooth_normals(std::span<const Vec3> vertices,
                                 std::span<const std::array<std::uint32_t, 3>> triangles) {
    std::vector<Vec3> normals(vertices.size());
    for (const auto& [a, b, c] : triangles) {
        const Vec3 twice_area = cross(vertices[b] - vertices[a], vertices[c] - vertices[a]);
        for (std::uint32_t v : {a, b, c})
            normals[v] += twice_area;
    }
    for (Vec3& n : normals)
        n = normalized(n);
    return normals;
}

} // namespace

RayScene::RayScene() : device_(rtcNewDevice("threads=1")), scene_(nullptr) {
    if (!device_)
        throw std::runtime_error("Embree cannot start: error " +
                                 std::to_string(rtcGetDeviceError(nullptr)));
    scene_ = rtcNewScene(device_);
}

RayScene::~RayScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

std::uint32_t RayScene::attach(RTCGeometry geometry, Shape shape) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_, geometry, static_cast<unsigned>(shapes_.size()));
    rtcReleaseGeometry(geometry);
    shapes_.push_back(std::move(shape));
    return static_cast<std::uint32_t>(shapes_.size() - 1);
}

std::uint32_t RayScene::add_ribbons(const Curves& curves, float width_scale) {
    const std::size_t strands = curves.first_vertex.size() - 1;
    Shape shape;
    shape.curves = true;
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_FLAT_CATMULL_ROM_CURVE);
    rtcSetGeometryTessellationRate(geometry, 2); // pieces are short: two quads bend enough
    const auto points = new_buffer<CurvePoint>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4,
                                               curves.position.size() + 2 * strands);
    const auto starts = new_buffer<unsigned>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT,
                                             curves.position.size() - strands);
    std::size_t point = 0, piece = 0;
    for (std::size_t s = 0; s < strands; ++s) {
        const std::uint32_t first = curves.first_vertex[s], last = curves.first_vertex[s + 1] - 1;
        const auto add = [&](std::uint32_t v) {
            points[point++] = {curves.position[v], 0.5f * width_scale * curves.width[v]};
        };
        add(first); // Embree's pieces run between their two inner points: the ends are doubled
        for (std::uint32_t v = first; v <= last; ++v) {
            if (v < last) {
                starts[piece++] = static_cast<unsigned>(point - 1);
                shape.strand_of.push_back(static_cast<std::uint32_t>(s));
            }
            add(v);
        }
        add(last);
    }
    return attach(geometry, std::move(shape));
}

std::uint32_t RayScene::add_mesh(std::span<const Vec3> vertices,
                                 std::span<const std::array<std::uint32_t, 3>> triangles) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto points =
        new_buffer<Vec3>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, vertices.size());
    const auto indices = new_buffer<std::array<std::uint32_t, 3>>(
        geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles.size());
    std::copy(vertices.begin(), vertices.end(), points.begin());
    std::copy(triangles.begin(), triangles.end(), indices.begin());
    rtcSetGeometryVertexAttributeCount(geometry, 1);
    const std::vector<Vec3> smooth = smooth_normals(vertices, triangles);
    const auto normals = new_buffer<Vec3>(geometry, RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE,
                                          RTC_FORMAT_FLOAT3, vertices.size());
    std::copy(smooth.begin(), smooth.end(), normals.begin());
    return attach(geometry, {});
}

void RayScene::commit() {
    rtcCommitScene(scene_);
}

RayHit RayScene::first_hit(const Vec3& from, const Vec3& direction) const {
    RTCRayHit query{};
    query.ray = {from.x,      from.y,      from.z,
                 0,           direction.x, direction.y,
                 direction.z, 0,           std::numeric_limits<float>::infinity(),
                 ~0u,         0,           0};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &query);
    RayHit hit;
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return hit;

    hit.distance = query.ray.tfar;
    hit.shape = query.hit.geomID;
    hit.point = from + direction * hit.distance;
    RTCGeometry geometry = rtcGetGeometry(scene_, hit.shape);
    float value[4] = {}, slope[4] = {};
    if (shapes_[hit.shape].curves) {
        hit.part = shapes_[hit.shape].strand_of[query.hit.primID];
        rtcInterpolate1(geometry, query.hit.primID, query.hit.u, query.hit.v,
                        RTC_BUFFER_TYPE_VERTEX, 0, value, slope, nullptr, 4);
        hit.direction = normalized(Vec3{slope[0], slope[1], slope[2]});
    } else {
        hit.part = query.hit.primID;
        rtcInterpolate0(geometry, query.hit.primID, query.hit.u, query.hit.v,
                        RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, 0, value, 3);
        hit.direction = normalized(Vec3{value[0], value[1], value[2]});
    }
    return hit;
}

bool RayScene::blocked(const Vec3& from, const Vec3& direction) const {
    RTCRay ray{from.x,      from.y,      from.z,
               0,           direction.x, direction.y,
               direction.z, 0,           std::numeric_limits<float>::infinity(),
               ~0u,         0,           0};
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene_, &context, &ray);
    return ray.tfar < 0;
}

} // namespace mane
