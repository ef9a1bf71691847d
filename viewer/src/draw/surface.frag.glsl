#version 300 es
precision highp float;
#include "surface_shading.glsl"
in vec3 vPosition;
in vec3 vNormal;
flat in vec3 vColour;
uniform vec3 uEye;
uniform float uOffset; // [m] off the surface, where its light is looked up
out vec4 oRadiance;
void main() {
    vec3 normal = normalize(vNormal);
    vec3 viewer = normalize(uEye - vPosition);
    if (dot(normal, viewer) < 0.0) normal = -normal;
    oRadiance = vec4(surfaceRadiance(vPosition, normal, vColour, viewer, uOffset), 1.0);
}
