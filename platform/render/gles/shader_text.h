#pragma once
// GLSL ES 1.00 text. Every scene shader starts with four defines from shaders.cpp:
//   KIND 0..5  as pack::MaterialKind: skin, eye, hair, cloth, mouth, lash
//   TIER 0..2  as scene::Shading: cheapest, per vertex, per pixel
//   PASS 0..3  as Pass: opaque, core, edge, glint
//   LINES 0..1 skin with lines in a detail texture: one fetch and one dot product more
// All light is computed in linear colour; texels and the framebuffer are sRGB.
namespace caryatid::platform::gles {

// GPU skinning: up to 30 bones of three rows, four influences. 90 + 15 uniform vectors.
inline constexpr char kVertexText[] = R"(
attribute vec3 a_position;
attribute vec4 a_normal;
attribute vec2 a_uv;
attribute vec4 a_bone;
attribute vec4 a_weight;
uniform vec4 u_bones[90];
uniform mat4 u_view_projection;
uniform vec3 u_eye;
varying vec2 v_uv;
#if LINES
uniform vec4 u_wrinkles[2];
varying vec4 v_wrinkles;
// The figure's left is in the left half of the head's texture.
void fold() {
  v_wrinkles = mix(u_wrinkles[0], u_wrinkles[1], clamp(12.0 * a_uv.x - 5.5, 0.0, 1.0));
}
#endif

void skin(out vec3 position, out vec3 normal) {
  int i = int(a_bone.x) * 3, j = int(a_bone.y) * 3, k = int(a_bone.z) * 3, l = int(a_bone.w) * 3;
  vec4 w = a_weight;
  vec4 x = w.x * u_bones[i] + w.y * u_bones[j] + w.z * u_bones[k] + w.w * u_bones[l];
  vec4 y = w.x * u_bones[i + 1] + w.y * u_bones[j + 1] + w.z * u_bones[k + 1] +
           w.w * u_bones[l + 1];
  vec4 z = w.x * u_bones[i + 2] + w.y * u_bones[j + 2] + w.z * u_bones[k + 2] +
           w.w * u_bones[l + 2];
  vec4 p = vec4(a_position, 1.0);
  position = vec3(dot(x, p), dot(y, p), dot(z, p));
  normal = normalize(vec3(dot(x.xyz, a_normal.xyz), dot(y.xyz, a_normal.xyz),
                          dot(z.xyz, a_normal.xyz)));
}
)";

inline constexpr char kVertexMain[] = R"(
// Brows and lashes are drawn as if 4 mm nearer to the eye: a lid that closes swells under them.
vec4 in_front(vec4 position) {
#if KIND == 5
  position.z -= 0.004;
#endif
  return position;
}
#if TIER == 2
varying vec4 v_normal;  // w: occlusion
varying vec3 v_view;
void main() {
  vec3 position, normal;
  skin(position, normal);
  v_normal = vec4(normal, a_normal.w);
  v_view = normalize(u_eye - position);
  v_uv = a_uv;
#if LINES
  fold();
#endif
  gl_Position = in_front(u_view_projection * vec4(position, 1.0));
}
#else
varying vec3 v_diffuse;
varying vec3 v_specular;
void main() {
  vec3 position, normal, diffuse, specular;
  skin(position, normal);
  light(normal, normalize(u_eye - position), clamp(1.0 - a_normal.w, 0.0, 1.0), diffuse, specular);
#if TIER == 1
  v_diffuse = diffuse * u_tint.rgb;
  v_specular = specular;
#else
  // Products of roots stand for roots of products: one multiply and one add a fragment.
  v_diffuse = sqrt(clamp(diffuse * u_tint.rgb, 0.0, 1.0));
  v_specular = specular;
#endif
  v_uv = a_uv;
#if LINES
  fold();
#endif
  gl_Position = in_front(u_view_projection * vec4(position, 1.0));
}
#endif
)";

// light(): what falls on a surface and what it throws back as highlight. Used per vertex or per
// fragment. `open` is 1 where the sky is free and 0 in a closed hollow.
inline constexpr char kLightText[] = R"(
uniform vec3 u_key_direction;
uniform vec3 u_key_color;
uniform vec3 u_fill_direction;
uniform vec3 u_fill_color;
uniform vec3 u_rim_direction;
uniform vec3 u_rim_color;
uniform vec3 u_ambient_up;
uniform vec3 u_ambient_down;
uniform vec4 u_tint;
uniform vec4 u_surface;  // gloss, shininess, two-sided, 0

// Light bleeds past the terminator, red furthest, as it does through skin. The curve keeps the
// energy of a wrapped cosine and falls softly to zero.
vec3 wrapped(float cosine, vec3 wrap) {
  vec3 x = clamp((cosine + wrap) / (1.0 + wrap), 0.0, 1.0);
  return x * mix(vec3(1.0), x, wrap);
}

float power5(float x) { float y = x * x; return y * y * x; }

// Blinn highlight, normalised so that its energy does not hang on the exponent.
float highlight(vec3 n, vec3 v, vec3 l, float shininess) {
  float c = max(dot(n, normalize(l + v)), 0.0);
  return pow(c, shininess) * (0.125 * shininess + 1.0);
}

void light(vec3 n, vec3 v, float open, out vec3 diffuse, out vec3 specular) {
  float facing = dot(n, v);
  if (u_surface.z > 0.5 && facing < 0.0) { n = -n; facing = -facing; }
  facing = clamp(facing, 0.0, 1.0);
  float graze = power5(1.0 - facing);
  float key = dot(n, u_key_direction);
  vec3 sky = mix(u_ambient_down, u_ambient_up, n.y * 0.5 + 0.5);
  float shade = open * (0.35 + 0.65 * open);  // Hollows lose the direct lights too.
#if KIND == 0 || KIND == 4
  vec3 wrap = vec3(0.46, 0.24, 0.18);
  // Light that has bounced inside a hollow of skin is red.
  vec3 reach = open + open * (1.0 - open) * vec3(0.62, 0.22, 0.12);
#elif KIND == 2 || KIND == 5
  vec3 wrap = vec3(0.35);
  vec3 reach = vec3(open);
#else
  vec3 wrap = vec3(0.15);
  vec3 reach = vec3(open);
#endif
#if KIND == 1
  // The upper lid and its lashes shade the ball below them, the corners see less light.
  shade = mix(0.42, 1.0, 1.0 - smoothstep(0.02, 0.5, n.y)) * mix(0.6, 1.0, facing);
  reach = vec3(shade);
#endif
  diffuse = u_key_color * wrapped(key, wrap) * shade +
            u_fill_color * wrapped(dot(n, u_fill_direction), wrap) * shade + sky * reach +
            u_rim_color * wrapped(dot(n, u_rim_direction), wrap) * open;
  specular = vec3(0.0);
#if TIER > 0
  float lit = clamp(key * 4.0 + 0.5, 0.0, 1.0) * shade;
#if KIND == 0
  // A broad sheen of the skin's surface under a narrow one of its oil.
  float broad = highlight(n, v, u_key_direction, u_surface.y * 0.3);
  float oily = highlight(n, v, u_key_direction, u_surface.y);
  float fresnel = 0.028 + 0.5 * graze;
  specular = u_key_color * lit * u_surface.x * fresnel * (0.6 * broad + 0.6 * oily);
  specular += open * (sky + u_rim_color * max(dot(n, u_rim_direction), 0.0)) * (0.25 * graze);
#elif KIND == 1
  float spark = highlight(n, v, u_key_direction, 120.0);
  float window = highlight(n, v, u_fill_direction, 60.0);
  specular = u_surface.x * (u_key_color * min(spark * 0.12, 1.0) + u_fill_color * window * 0.04);
  specular += sky * ((0.02 + 0.3 * graze) * shade);
#elif KIND == 2
  // Strands run down over the head: their tangent is the way down along the surface.
  vec3 t = normalize(vec3(0.0, -1.0, 0.08) + n * (n.y + 0.15));
  float along = dot(t, normalize(u_key_direction + v));
  float across = sqrt(max(1.0 - along * along, 0.0));
  float shine = pow(across, u_surface.y) * u_surface.x;
  float along_rim = dot(t, normalize(u_rim_direction + v));
  float rim_shine = pow(max(1.0 - along_rim * along_rim, 0.0), 6.0) * (1.0 - facing);
  specular = u_key_color * (shine * lit) + u_rim_color * (rim_shine * open);
#elif KIND == 3
  float broad = highlight(n, v, u_key_direction, u_surface.y);
  specular = u_key_color * lit * u_surface.x * 0.04 * broad;
  diffuse += sky * open * (0.35 * (1.0 - facing) * (1.0 - facing));  // Fibres catch grazing light.
#elif KIND == 4
  float wet = highlight(n, v, u_key_direction, u_surface.y);
  specular = u_key_color * lit * open * u_surface.x * 0.035 * wet;
#endif
#endif
}
)";

inline constexpr char kFragmentText[] = R"(
precision mediump float;
varying vec2 v_uv;
uniform sampler2D u_texture;

// Cubic and root approximations of the sRGB curve, within half a step of 8 bits in the mid-tones.
vec3 to_linear(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }
vec3 to_srgb(vec3 c) {
  vec3 a = sqrt(clamp(c, 0.0, 1.0));
  vec3 b = sqrt(a);
  return 0.662002687 * a + 0.684122060 * b - 0.323583601 * sqrt(b) - 0.0225411470 * c;
}
// Above a shoulder highlights approach white instead of clipping.
vec3 expose(vec3 c) {
  vec3 over = max(c - 0.7, 0.0);
  return min(c, 0.7) + 0.3 * over / (0.3 + over);
}
// Keeps the part of a hair texture that this pass draws and gives how much it covers. What counts
// as dense covers whole, so that the two passes meet without a step.
float keep(float alpha) {
#if PASS == 1
  if (alpha < 0.8) discard;
  return 1.0;
#elif PASS == 2 && KIND == 5
  if (alpha < 0.02) discard;  // Lashes and brows lie flat on what they cover: one pass will do.
  return alpha;
#elif PASS == 2
  if (alpha < 0.02 || alpha >= 0.8) discard;
  return alpha * 1.25;
#else
  return alpha;
#endif
}
)";

inline constexpr char kFragmentMain[] = R"(
#if TIER == 2
varying vec4 v_normal;
varying vec3 v_view;
#else
varying vec3 v_diffuse;
varying vec3 v_specular;
#endif
#if LINES
uniform sampler2D u_detail;
varying vec4 v_wrinkles;
#endif

void main() {
  vec4 texel = texture2D(u_texture, v_uv);
#if TIER == 2 && KIND == 2
  // Towards its outline a head of hair is single strands, not a wall.
  texel.a *= clamp(5.0 * abs(dot(normalize(v_normal.xyz), normalize(v_view))) - 0.1, 0.0, 1.0);
#endif
  texel.a = keep(texel.a);
#if TIER == 0
  gl_FragColor = vec4(texel.rgb * v_diffuse + v_specular, texel.a);
#else
  vec3 albedo = to_linear(texel.rgb);
#if TIER == 2
  vec3 diffuse, specular;
  light(normalize(v_normal.xyz), normalize(v_view), clamp(1.0 - v_normal.w, 0.0, 1.0), diffuse,
        specular);
  diffuse *= u_tint.rgb;
#else
  vec3 diffuse = v_diffuse, specular = v_specular;
#endif
#if LINES
  // Folds: shade in the furrow, redder than the skin, and light on the ridge. 8/15 is level.
  float fold = dot(texture2D(u_detail, v_uv) - 0.5333, v_wrinkles);
  albedo *= max(vec3(1.0) + fold * vec3(0.85, 1.1, 1.15), 0.0);
  specular *= max(1.0 + 2.0 * fold, 0.0);
#endif
#if KIND == 0
  // Lips are redder than skin, and moist.
  specular *= 1.0 + 1.6 * clamp(8.0 * albedo.r - 19.0 * albedo.g, 0.0, 1.0);
#elif KIND == 2
  specular *= albedo * 1.1 + 0.012;  // Light that has passed through a strand takes its colour.
#endif
#if PASS == 3
  gl_FragColor = vec4(to_srgb(expose(specular)), 1.0);
#else
  gl_FragColor = vec4(to_srgb(expose(albedo * diffuse + specular)), texel.a);
#endif
#endif
}
)";

inline constexpr char kQuadVertex[] = R"(
attribute vec2 a_position;
uniform vec2 u_scale;
varying vec2 v_uv;
void main() {
  v_uv = a_position * u_scale;
  gl_Position = vec4(a_position * 2.0 - 1.0, 0.0, 1.0);
}
)";
inline constexpr char kQuadFragment[] = R"(
precision mediump float;
varying vec2 v_uv;
uniform sampler2D u_texture;
void main() { gl_FragColor = texture2D(u_texture, v_uv); }
)";

// A still picture: a_uv reaches beyond 0..1 where the display is wider than it.
inline constexpr char kStillVertex[] = R"(
attribute vec2 a_position;
attribute vec2 a_uv;
varying vec2 v_uv;
void main() {
  v_uv = a_uv;
  gl_Position = vec4(a_position, 0.0, 1.0);
}
)";

// A vertical gradient at the far plane; a little noise hides its 8-bit steps.
inline constexpr char kBackgroundVertex[] = R"(
attribute vec2 a_position;
uniform vec2 u_right;  // The picture's, on a panel that may be mounted turned.
varying vec2 v_uv;
void main() {
  vec2 at = a_position - 0.5;
  v_uv = vec2(dot(u_right, at), dot(vec2(-u_right.y, u_right.x), at)) + 0.5;
  gl_Position = vec4(a_position * 2.0 - 1.0, 1.0, 1.0);
}
)";
inline constexpr char kBackgroundFragment[] = R"(
precision mediump float;
varying vec2 v_uv;
uniform vec3 u_top;
uniform vec3 u_bottom;
void main() {
  float t = v_uv.y * v_uv.y * (3.0 - 2.0 * v_uv.y);
  vec2 side = v_uv - vec2(0.5, 0.6);
  vec3 c = mix(u_bottom, u_top, t) * (1.0 - 0.3 * dot(side, side));
  float noise = fract(52.98 * fract(dot(gl_FragCoord.xy, vec2(0.0671, 0.00584))));
  gl_FragColor = vec4(c + (noise - 0.5) / 255.0, 1.0);
}
)";

inline constexpr char kFloorShadowVertex[] = R"(
attribute vec2 a_position;
uniform mat4 u_view_projection;
uniform vec3 u_center;
uniform vec2 u_half;
varying vec2 v_uv;
void main() {
  v_uv = a_position * 2.0 - 1.0;
  vec2 p = v_uv * u_half;
  gl_Position = u_view_projection * vec4(u_center + vec3(p.x, 0.0, p.y), 1.0);
}
)";
inline constexpr char kFloorShadowFragment[] = R"(
precision mediump float;
varying vec2 v_uv;
uniform float u_strength;
void main() {
  float d = max(1.0 - dot(v_uv, v_uv), 0.0);
  gl_FragColor = vec4(0.0, 0.0, 0.0, u_strength * d * d);
}
)";

// Letters and boxes from a distance field on unit 0, a picture on unit 1. The shape holds where the
// edge lies, how sharp it is (in quarters) and whether it is a picture.
inline constexpr char kOverlayVertex[] = R"(
attribute vec2 a_position;
attribute vec2 a_uv;
attribute vec4 a_normal;
attribute vec4 a_bone;
uniform vec4 u_place;
varying vec2 v_uv;
varying vec4 v_ink;
varying vec3 v_shape;
void main() {
  v_uv = a_uv;
  v_ink = a_normal;
  v_shape = vec3(a_bone.x, a_bone.y * 63.75, a_bone.z);
  vec2 p = vec2(a_position.x * u_place.x - 1.0, 1.0 - a_position.y * u_place.y);
  vec2 turned = vec2(u_place.z * p.x + u_place.w * p.y, u_place.z * p.y - u_place.w * p.x);
  gl_Position = vec4(turned, 0.0, 1.0);
}
)";
inline constexpr char kOverlayFragment[] = R"(
precision mediump float;
varying vec2 v_uv;
varying vec4 v_ink;
varying vec3 v_shape;
uniform sampler2D u_texture;
uniform sampler2D u_picture;
void main() {
  float field = texture2D(u_texture, v_uv).a;
  float cover = clamp((field - v_shape.x) * v_shape.y + 0.5, 0.0, 1.0);
  vec3 picture = texture2D(u_picture, v_uv).rgb;
  gl_FragColor = vec4(mix(v_ink.rgb, picture, v_shape.z), v_ink.a * mix(cover, 1.0, v_shape.z));
}
)";

}  // namespace caryatid::platform::gles
