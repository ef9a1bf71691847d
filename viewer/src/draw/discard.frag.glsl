#version 300 es
// Beside a vertex shader whose output is read back and not drawn.
precision highp float;
void main() {}
