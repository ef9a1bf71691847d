#version 300 es
// Straight lines with a width at each end, in pixels or metres, toward the viewer; a tapered one is an arrow's head, one without
// length a dot.
precision highp float;
precision highp int;
layout(location = 0) in vec4 aBegin; // position, width
layout(location = 1) in vec4 aEnd;
layout(location = 2) in vec4 aColour; // sRGB, opacity
uniform mat4 uClip;
uniform vec2 uViewport; // [pixels]
uniform float uPixel;   // [1] a pixel's size at distance 1
out vec4 vColour;
out vec3 vAcross; // place across the line in pixels from its middle, its half width there; 1 for dots
const float kFeather = 1.0; // [pixels]

void main() {
    bool atEnd = (gl_VertexID & 2) != 0;
    float side = (gl_VertexID & 1) != 0 ? 1.0 : -1.0;
    vec4 a = uClip * vec4(aBegin.xyz, 1.0), b = uClip * vec4(aEnd.xyz, 1.0);
    vec4 here = atEnd ? b : a;
    float width = atEnd ? aEnd.w : aBegin.w;
    if (width < 0.0) width = -width; // in pixels
    else width /= uPixel * max(here.w, 1e-3);
    vec2 way = (b.xy / max(b.w, 1e-3) - a.xy / max(a.w, 1e-3)) * uViewport;
    float length2 = dot(way, way);
    bool dot_ = length2 < 1e-6;
    vec2 along = dot_ ? vec2(1.0, 0.0) : way * inversesqrt(length2);
    float reach = 0.5 * width + kFeather;
    vec2 offset = vec2(-along.y, along.x) * side * reach;
    if (dot_) offset += along * (atEnd ? reach : -reach);
    here.xy += offset * 2.0 / uViewport * here.w;
    vColour = aColour;
    vAcross = vec3(side * reach, dot_ ? (atEnd ? reach : -reach) : 0.0, 0.5 * width);
    gl_Position = here;
}
