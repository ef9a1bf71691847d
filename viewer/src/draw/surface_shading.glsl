// A surface that is matt with a little gloss: skin, obstacles, envelopes.
#include "light.glsl"

vec3 surfaceRadiance(vec3 position, vec3 normal, vec3 colour, vec3 viewer, float offset) {
    vec4 shade = shadeAt(position + normal * offset);
    vec3 sum = uSkyRadiance * shade.w * colour * (0.75 + 0.25 * normal.y);
    for (int i = 0; i < kLights; ++i) {
        // Light goes a little round the terminator, as it does under skin.
        float wrapped = (dot(normal, uLightDirection[i]) + 0.15) / 1.15;
        if (wrapped <= 0.0) continue;
        vec3 lit = reaching(shade[i], vec3(0.3, 0.2, 0.15));
        float gloss = 0.04 * pow(max(dot(normal, normalize(viewer + uLightDirection[i])), 0.0), 24.0);
        sum += uLightRadiance[i] * lit * (colour * (wrapped / 3.14159265) + gloss);
    }
    return sum;
}
