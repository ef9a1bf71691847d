#include "character/remesh.h"

#include "character/edit_mesh.h"

#include <algorithm>

namespace mane {
namespace {

// Distance and its gradient from four values around the point.
struct LocalDistance {
    double value;
    Vec3d gradient;
};
LocalDistance distance_near(double (*distance)(const Vec3d&), const Vec3d& p) {
    const double h = 1e-4; // [m] well under the smallest feature
    const double a = distance(p + Vec3d(h, -h, -h)), b = distance(p + Vec3d(-h, -h, h));
    const double c = distance(p + Vec3d(-h, h, -h)), d = distance(p + Vec3d(h, h, h));
    return {(a + b + c + d) / 4, Vec3d(a - b - c + d, -a - b + c + d, -a + b - c + d) / (4 * h)};
}

class Remesher {
  public:
    Remesher(const Mesh& mesh, const RemeshTarget& target) : mesh_(mesh), target_(target) {}

    Mesh run(int rounds) {
        for (int round = 0; round < rounds; ++round) {
            split_long_edges();
            collapse_short_edges();
            flip_edges();
            relax();
        }
        for (int round = 0; round < 3; ++round) {
            flip_edges();
            relax();
        }
        settle();
        return mesh_.finished();
    }

  private:
    double edge_length(const EditMesh::Edge& e) const {
        return length(mesh_.position(e.b) - mesh_.position(e.a));
    }
    Vec3d middle(const EditMesh::Edge& e) const {
        return (mesh_.position(e.a) + mesh_.position(e.b)) * 0.5;
    }

    // Calls `visit` for the edges, each once; triangles that appear on the way wait for the next
    // round.
    template <typename Visit> void for_each_edge(Visit visit) {
        const std::size_t count = mesh_.triangle_slots();
        for (std::size_t t = 0; t < count; ++t)
            for (std::size_t k = 0; k < 3 && mesh_.has_triangle(t); ++k)
                if (mesh_.triangle(t)[k] < mesh_.triangle(t)[(k + 1) % 3])
                    visit(mesh_.edge(t, k));
    }

    // The limits around the wanted length between which neither splitting nor collapsing brings an
    // edge nearer to it.
    void split_long_edges() {
        for_each_edge([&](const EditMesh::Edge& e) {
            const Vec3d m = middle(e);
            if (edge_length(e) > 4.0 / 3 * target_.edge_length(m))
                mesh_.split(e, on_surface(m).position);
        });
    }
    void collapse_short_edges() {
        for_each_edge([&](const EditMesh::Edge& e) {
            const Vec3d m = middle(e);
            const double wanted = target_.edge_length(m);
            if (!(edge_length(e) < 4.0 / 5 * wanted))
                return;
            const SurfacePoint to = on_surface(m);
            mesh_.collapse(e, to.position, to.normal, 4.0 / 3 * wanted);
        });
    }
    void flip_edges() {
        for_each_edge([&](const EditMesh::Edge& e) {
            if (mesh_.flip_widens(e))
                mesh_.flip(e, on_surface(middle(e)).normal);
        });
    }

    struct SurfacePoint {
        Vec3d position, normal;
    };
    // Two of Newton's steps along the gradient.
    SurfacePoint on_surface(Vec3d p) const {
        Vec3d normal;
        for (int step = 0; step < 2; ++step) {
            const LocalDistance near = distance_near(target_.distance, p);
            const double slope = dot(near.gradient, near.gradient);
            if (!(slope > 0.01))
                break;
            p -= near.gradient * (near.value / slope);
            normal = normalized(near.gradient);
        }
        return {p, normal};
    }

    // The centroid of the triangles around v, weighted so that all count alike where they have the
    // wanted size.
    Vec3d centroid_around(std::uint32_t v) const {
        Vec3d sum;
        double weights = 0;
        for (std::uint32_t t : mesh_.triangles_around(v)) {
            const auto& [a, b, c] = mesh_.triangle(t);
            const Vec3d centre = (mesh_.position(a) + mesh_.position(b) + mesh_.position(c)) / 3.0;
            const double wanted = target_.edge_length(centre);
            const double weight = length(mesh_.area_vector({a, b, c})) / (wanted * wanted);
            sum += centre * weight;
            weights += weight;
        }
        return weights > 0 ? sum / weights : mesh_.position(v);
    }

    // Each vertex along the surface toward that centroid, unless a triangle would turn over.
    void relax() {
        for (std::uint32_t v = 0; v < mesh_.vertex_slots(); ++v) {
            if (mesh_.triangles_around(v).empty())
                continue;
            const SurfacePoint from = on_surface(mesh_.position(v));
            const Vec3d way = centroid_around(v) - from.position;
            const SurfacePoint to =
                on_surface(from.position + way - from.normal * dot(way, from.normal));
            const double before = mesh_.least_cosine(v, mesh_.position(v), from.normal);
            const double enough = std::min(EditMesh::kSteepest, before);
            if (mesh_.least_cosine(v, to.position, to.normal) >= enough)
                mesh_.move(v, to.position);
        }
    }

    // All vertices onto the surface, those too that could not move along it.
    void settle() {
        for (int step = 0; step < 2; ++step)
            for (std::uint32_t v = 0; v < mesh_.vertex_slots(); ++v)
                if (!mesh_.triangles_around(v).empty())
                    mesh_.move(v, on_surface(mesh_.position(v)).position);
    }

    EditMesh mesh_;
    RemeshTarget target_;
};

} // namespace

Mesh remesh(const Mesh& mesh, const RemeshTarget& target, int rounds) {
    return Remesher(mesh, target).run(rounds);
}

} // namespace mane
