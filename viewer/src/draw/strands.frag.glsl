#version 300 es
precision highp float;
precision highp int;
in vec3 vRadiance;
in float vCoverage;
flat in uint vStrand;
uniform int uPass;
out vec4 oRadiance;

// What covers a part of a pixel covers the whole of it in so many of the passes: each strand, pixel and pass by a chance of its
// own, since strands behind each other that left out the same pixels would be seen through.
float chance(uvec2 pixel) {
    uint n = pixel.x * 1597334677u ^ pixel.y * 3812015801u ^ vStrand * 2654435769u ^ uint(uPass) * 668265263u;
    n = (n ^ (n >> 16)) * 2246822519u;
    n = (n ^ (n >> 13)) * 3266489917u;
    return float(n >> 8) / 16777216.0;
}

void main() {
    if (vCoverage < 1.0 && vCoverage < chance(uvec2(gl_FragCoord.xy))) discard;
    oRadiance = vec4(vRadiance, 1.0);
}
