// Light that a strand sends to the viewer, as src/picture/hair_shading.cpp: Marschner et al. 2003 in the closed form of Karis 2016.
// The highlight R on the surface, TT through the strand and the coloured highlight TRT, shifted apart by the cuticle's scales;
// and light that other strands have scattered, which looks matt.
#include "light.glsl"

uniform float uRoughness; // [1] of the longitudinal lobes
uniform float uTilt;      // [rad] of the scales, toward the root

const float kFacing = 0.0465; // reflectance of keratin (index 1.55) seen straight on

float fresnel(float cosine) {
    float c = 1.0 - clamp(cosine, 0.0, 1.0), c2 = c * c;
    return kFacing + (1.0 - kFacing) * c2 * c2 * c;
}
float lobe(float width, float angle) {
    return exp(-0.5 * angle * angle / (width * width)) / (2.5066 * width);
}

vec3 scatteredOnce(vec3 colour, float tilt, vec3 tangent, vec3 viewer, vec3 light) {
    float sinV = clamp(dot(tangent, viewer), -1.0, 1.0), sinL = clamp(dot(tangent, light), -1.0, 1.0);
    float cosD = max(cos(0.5 * abs(asin(sinV) - asin(sinL))), 0.1);
    vec3 acrossV = viewer - tangent * sinV, acrossL = light - tangent * sinL;
    float cosPhi = clamp(dot(acrossV, acrossL) * inversesqrt(dot(acrossV, acrossV) * dot(acrossL, acrossL) + 1e-8), -1.0, 1.0);
    float cosHalfPhi = sqrt(0.5 + 0.5 * cosPhi);
    float width = uRoughness * uRoughness, angle = sinL + sinV;

    float r = lobe(width * 1.414 * max(cosHalfPhi, 0.1), angle + 2.0 * tilt * cosHalfPhi) * 0.25 * cosHalfPhi *
              fresnel(sqrt(clamp(0.5 + 0.5 * dot(viewer, light), 0.0, 1.0)));

    float a = 1.0 / (1.19 / cosD + 0.36 * cosD);
    float h = cosHalfPhi * (1.0 + a * (0.6 - 0.8 * cosPhi));
    float entering = 1.0 - fresnel(cosD * sqrt(clamp(1.0 - h * h, 0.0, 1.0)));
    float path = sqrt(max(1.0 - h * h * a * a, 0.0)) / cosD;
    vec3 tt = pow(colour, vec3(0.5 * path)) *
              (lobe(width * 0.5, angle - tilt) * entering * entering * exp(-3.65 * cosPhi - 3.98));

    float inner = fresnel(cosD * 0.5);
    vec3 trt = pow(colour, vec3(0.8 / cosD)) *
               (lobe(width * 2.0, angle - 4.0 * tilt) * (1.0 - inner) * (1.0 - inner) * inner * exp(17.0 * cosPhi - 16.78));
    return r + tt + trt;
}

vec3 scatteredOften(vec3 colour, vec3 tangent, vec3 viewer, vec3 light, vec3 lit) {
    vec3 facing = normalize(viewer - tangent * dot(viewer, tangent) + 1e-6);
    float wrapped = max(0.0, (dot(facing, light) + 1.0) / 4.0) / 3.14159265;
    float luminance = max(dot(colour, vec3(0.2126, 0.7152, 0.0722)), 1e-3);
    vec3 hue = pow(colour / luminance, vec3(1.0 - clamp((lit.x + lit.y + lit.z) / 3.0, 0.0, 1.0)));
    return pow(colour, vec3(0.75)) * hue * (0.6 * wrapped);
}

vec3 hairRadiance(vec3 position, vec3 colour, vec3 tangent, vec3 viewer, float tilt) {
    vec4 shade = shadeAt(position);
    vec3 c = clamp(colour, 1e-4, 0.99);
    vec3 sum = uSkyRadiance * shade.w * c * 0.55;
    for (int i = 0; i < kLights; ++i) {
        vec3 lit = reaching(shade[i], c);
        sum += uLightRadiance[i] * lit * (scatteredOnce(c, tilt, tangent, viewer, uLightDirection[i]) +
                                          scatteredOften(c, tangent, viewer, uLightDirection[i], lit));
    }
    return sum;
}
