#include "interactions/character_contact.h"
#include "mane/error.h"

#include <sstream>

namespace mane {

void check_roots(const HairView& hair, std::span<const ContactBody> bodies,
                 std::span<const std::string> names) {
    for (std::size_t w = 0; w < hair.groom.wisp_count(); ++w) {
        const Vec3 x1 = hair.state.position.vec(hair.layout.slot(hair.groom.first_section[w] + 1));
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            if (bodies[b].worn || !bodies[b].surface->start().inside(Vec3d(x1)))
                continue;
            const auto nearest = bodies[b].surface->start().nearest(Vec3d(x1), 1e3);
            std::ostringstream message;
            message
                << "wisp " << w << ": its section 1 is inside " << names[b] << ", "
                << std::sqrt(nearest->closest.squared) * 1000
                << " mm deep; it must be just outside (raise the root, or mark the body as worn)";
            throw InputError(message.str());
        }
    }
}

} // namespace mane
