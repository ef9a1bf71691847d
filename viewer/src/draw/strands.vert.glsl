#version 300 es
// A strand as a ribbon toward the viewer: an instance each, two vertices for each of its n places.
precision highp float;
precision highp int;
#include "strand.glsl"
#include "hair_shading.glsl"
#include "wisp_colour.glsl"

layout(location = 0) in vec4 aPlace; // disc x, y; end; phase
layout(location = 1) in uvec4 aWisp; // first section, how many more, first share, wisp

uniform mat4 uClip;       // from the frame's coordinates
uniform vec3 uEye;
uniform int uVertices;    // n
uniform vec2 uWidth;      // [m] at root and tip, as drawn
uniform float uPixel;     // [1] a pixel's size at distance 1
uniform vec3 uColour;
uniform bool uByWisp;
uniform int uSelected;    // wisp; −1: none

out vec3 vRadiance;

// No two hairs of a head have quite the same colour.
float varied(uint n) {
    n = (n ^ 61u) ^ (n >> 16);
    n *= 9u;
    n = (n ^ (n >> 4)) * 0x27d4eb2du;
    return mix(0.75, 1.3, float((n ^ (n >> 15)) >> 8) / 16777216.0);
}

void main() {
    Strand s = Strand(int(aWisp.x), int(aWisp.y), int(aWisp.z), aPlace.xy, aPlace.z, aPlace.w);
    int i = gl_VertexID >> 1;
    StrandPoint p = strandPoint(s, vertexParameter(s, i, uVertices));
    vec3 toEye = uEye - p.position;
    float distance = length(toEye);
    vec3 viewer = toEye / distance, tangent = normalize(p.along);
    vec3 colour = (uByWisp ? wispColour(int(aWisp.w)) : uColour) * varied(aWisp.z);
    vRadiance = hairRadiance(p.position, colour, tangent, viewer);
    if (uSelected >= 0) vRadiance = int(aWisp.w) == uSelected ? vRadiance * 1.5 + vec3(0.03, 0.05, 0.07) : vRadiance * 0.45;

    float width = max(mix(uWidth.x, uWidth.y, float(i) / float(uVertices - 1)), 0.6 * uPixel * distance);
    vec3 side = normalize(cross(tangent, viewer) + 1e-9) * (0.5 * width);
    gl_Position = uClip * vec4((gl_VertexID & 1) == 0 ? p.position - side : p.position + side, 1.0);
}
