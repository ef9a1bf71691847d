#version 300 es
// A strand, an instance each: a ribbon toward the viewer with two vertices for each of its n places, or a line of one pixel with
// one, which costs half as much and serves where a strand is not wider than that.
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
uniform bool uRibbon;
uniform vec2 uWidth;      // [m] at root and tip, as drawn
uniform float uPixel;     // [1] a pixel's size at distance 1
uniform vec3 uColour;
uniform bool uByWisp;
uniform int uSelected;    // wisp; −1: none

out vec3 vRadiance;
out float vCoverage;  // share of a pixel that a line covers
flat out uint vStrand; // a number of its own

float random(uint n) {
    n = (n ^ 61u) ^ (n >> 16);
    n *= 9u;
    n = (n ^ (n >> 4)) * 0x27d4eb2du;
    return float((n ^ (n >> 15)) >> 8) / 16777216.0;
}

// No two hairs of a head have quite the same colour, and neighbours in a wisp keep together in locks of more or less of it.
float varied(uint strand, uint wisp, vec2 place) {
    vec2 cell = floor(place * 3.5 + 8.0);
    uint lock = wisp * 256u + uint(cell.x) * 16u + uint(cell.y);
    return mix(0.75, 1.3, random(strand)) * mix(0.78, 1.22, random(lock + 7919u));
}

void main() {
    Strand s = Strand(int(aWisp.x), int(aWisp.y), int(aWisp.z), aPlace.xy, aPlace.z, aPlace.w);
    int i = uRibbon ? gl_VertexID >> 1 : gl_VertexID;
    StrandPoint p = strandPoint(s, vertexParameter(s, i, uVertices));
    vec3 toEye = uEye - p.position;
    float distance = length(toEye);
    vec3 viewer = toEye / distance, tangent = normalize(p.along);
    vec3 colour = (uByWisp ? wispColour(int(aWisp.w)) : uColour) * varied(aWisp.z, aWisp.w, aPlace.xy);
    vRadiance = hairRadiance(p.position, colour, tangent, viewer, uTilt + 0.05 * (random(aWisp.z + 104729u) - 0.5));
    if (uSelected >= 0) vRadiance = int(aWisp.w) == uSelected ? vRadiance * 1.5 + vec3(0.03, 0.05, 0.07) : vRadiance * 0.45;

    float width = mix(uWidth.x, uWidth.y, float(i) / float(uVertices - 1)), pixel = uPixel * distance;
    vec3 side = vec3(0.0);
    vCoverage = width / pixel;
    vStrand = aWisp.z;
    if (uRibbon) {
        side = normalize(cross(tangent, viewer) + 1e-9) * (0.5 * max(width, 0.6 * pixel));
        if ((gl_VertexID & 1) == 0) side = -side;
        vCoverage = 1.0;
    }
    gl_Position = uClip * vec4(p.position + side, 1.0);
}
