#version 300 es
precision highp float;
in vec3 vRadiance;
out vec4 oRadiance;
void main() {
    oRadiance = vec4(vRadiance, 1.0);
}
