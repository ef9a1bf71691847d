// Three lights that go with the camera's heading, a sky, and what hair and body leave of each at a point: optical depths in a
// coarse grid (light_volume.ts), read once per vertex.
const int kLights = 3;
uniform vec3 uLightDirection[kLights]; // toward the light
uniform vec3 uLightRadiance[kLights];
uniform vec3 uSkyRadiance;
uniform highp sampler3D uShade; // per light e^(−depth/4), and the share of the sky that is seen
uniform vec3 uShadeLow, uShadeScale;

vec4 shadeAt(vec3 p) {
    return textureLod(uShade, (p - uShadeLow) * uShadeScale, 0.0);
}
// What is left of a light after strands that keep `tint` of it: most of what a strand scatters goes on forward.
vec3 reaching(float shade, vec3 tint) {
    return pow(vec3(max(shade, 1e-4)), 4.0 * (1.0 - 0.5 * tint));
}
