#version 300 es
precision highp float;
layout(location = 0) in vec3 aPosition;
layout(location = 1) in vec3 aNormal;
uniform mat4 uClip;
out vec3 vPosition;
out vec3 vNormal;
flat out vec3 vColour;
uniform vec3 uColour;
void main() {
    vPosition = aPosition;
    vNormal = aNormal;
    vColour = uColour;
    gl_Position = uClip * vec4(aPosition, 1.0);
}
