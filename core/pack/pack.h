#pragma once
// The asset pack: the one binary format that the board loads. Little-endian.
//
// Two views of the same bytes:
//  - the *image*: one contiguous block in the arena in which every section lies at its offset. This
//    is what the agent reads while it runs; it is borrowed, validated once, then trusted.
//  - the *file*: PackHeader, Section table, Chunk table, then the chunks' payloads in load order.
//    Each chunk says which bytes of the image it fills. The chunks of the base part come first
//    (everything that a first frame needs: coarse meshes, their animation, small textures), then
//    refinements, coarse to fine. So a character is shown while the rest still loads, and a damaged
//    refinement leaves the last good level on the screen.
//
// Positions are metres in the frame of core/base/vec.h, in the H-Anim rest pose, MPEG-4 neutral
// face.
#include <cstddef>
#include <cstdint>

#include "core/base/vec.h"

namespace caryatid::pack {

inline constexpr char kMagic[8] = {'C', 'A', 'R', 'Y', 'P', 'A', 'C', 'K'};
inline constexpr std::uint32_t kVersion = 1;

struct PackHeader {
  char magic[8];
  std::uint32_t version;
  std::uint32_t section_count;
  std::uint32_t chunk_count;
  std::uint32_t base_chunk_count;  // The first so many chunks make the first frame.
  std::uint32_t file_bytes;
  std::uint32_t image_bytes;
  std::uint32_t arena_bytes;  // What the agent needs in all with this pack: image, working memory.
  std::uint32_t tables_crc;   // CRC-32C of the section and chunk tables.
  std::uint32_t reserved[5];
  std::uint32_t header_crc;  // CRC-32C of the 60 bytes before it. Last.
};
static_assert(sizeof(PackHeader) == 64);

// What a section holds. Values are fourccs so that a hex dump can be read.
constexpr std::uint32_t fourcc(char a, char b, char c, char d) {
  return static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b) << 8 |
         static_cast<std::uint32_t>(c) << 16 | static_cast<std::uint32_t>(d) << 24;
}
enum class SectionId : std::uint32_t {
  character = fourcc('C', 'H', 'A', 'R'),       // 1 Character
  joints = fourcc('J', 'O', 'I', 'N'),          // Joint, parents before children
  materials = fourcc('M', 'A', 'T', 'L'),       // Material
  textures = fourcc('T', 'E', 'X', 'I'),        // Texture; their texels are in `texels`
  texels = fourcc('T', 'E', 'X', 'D'),          // bytes
  objects = fourcc('O', 'B', 'J', 'S'),         // Object
  versions = fourcc('V', 'E', 'R', 'T'),        // Vertex: every vertex version once, by object,
                                                // base vertices first, then in split order
  base_indices = fourcc('I', 'N', 'D', 'X'),    // u16 triples of every object's base mesh
  splits = fourcc('S', 'P', 'L', 'T'),          // Split, by object, coarse to fine
  split_data = fourcc('S', 'P', 'L', 'D'),      // u16 words that splits refer to
  channels = fourcc('C', 'H', 'A', 'N'),        // Channel: pieces of the FAT
  fat_first = fourcc('F', 'A', 'T', 'F'),       // u32 a vertex version, + 1: its first Move
  fat_moves = fourcc('F', 'A', 'T', 'M'),       // Move
  feature_points = fourcc('F', 'D', 'P', 'S'),  // FeaturePoint
  rest_face = fourcc('R', 'E', 'S', 'T'),       // 69 floats: FAPs of the calm face, index = FAP
  licences = fourcc('L', 'I', 'C', 'E'),        // UTF-8 text
  fit = fourcc('F', 'I', 'T', 'R'),             // FitRule: FAP interpolation; may be missing
};

struct Section {
  std::uint32_t id;
  std::uint32_t offset;  // In the image, 16-byte aligned.
  std::uint32_t bytes;
  std::uint32_t stride;  // sizeof of one element; bytes is a multiple.
};
static_assert(sizeof(Section) == 16);

struct Chunk {
  std::uint32_t section;         // Index into the section table.
  std::uint32_t section_offset;  // First byte of the section that this chunk fills.
  std::uint32_t bytes;
  std::uint32_t crc;  // CRC-32C of the payload.
};
static_assert(sizeof(Chunk) == 16);

// The character as a whole. FAPU are distances of the neutral face in metres (ISO/IEC 14496-2 annex
// C, thesis table 7-1); one FAP unit is 1/1024 of them.
struct Character {
  char name[32];           // Zero-terminated.
  float iris_diameter_m;   // IRISD0
  float eye_separation_m;  // ES0
  float eye_nose_m;        // ENS0
  float mouth_nose_m;      // MNS0
  float mouth_width_m;     // MW0
  float stature_m;
  float leg_length_m;             // Hip joint to floor.
  std::uint32_t total_triangles;  // All objects at full resolution.
};

inline constexpr std::uint16_t kNoJoint = 0xFFFF;
struct Joint {
  float center_m[3];     // Rest position.
  std::uint16_t parent;  // Index into joints, less than the own; kNoJoint for the root.
  std::uint16_t hanim;   // body::HanimJoint, or from kHanimJointCount on body::HelperJoint.
};

enum class MaterialKind : std::uint16_t { skin, eye, hair, cloth, mouth, lash };
enum MaterialFlags : std::uint16_t {
  kTwoSided = 1,
  kAlphaBlend = 2,  // Hair, brows, lashes: alpha-tested core first, then blended edge.
  kCornea = 4,      // Drawn last, highlight only.
};
inline constexpr std::uint16_t kNoTexture = 0xFFFF;
struct Material {
  MaterialKind kind;
  std::uint16_t flags;
  std::uint16_t texture;  // Index into textures.
  std::uint16_t detail;   // Second texture (wrinkles, normal detail) or kNoTexture.
  float tint[4];          // Multiplies the texture, linear light.
  float gloss;            // Specular strength 0..1.
  float shininess;        // Blinn exponent, 1..128.
};

enum class TextureFormat : std::uint16_t { rgb565, rgba4444, etc1 };
struct Texture {
  std::uint16_t width, height;  // Power of two, at most 1024.
  TextureFormat format;
  std::uint16_t level_count;   // Full mip chain, largest first.
  std::uint32_t texel_offset;  // In `texels`.
  std::uint32_t texel_bytes;
  std::uint32_t base_level;  // The base part holds the levels from this one on; larger come later.
};

enum class ObjectRole : std::uint16_t { head, body, hair, clothes, eye, mouth, brow, lash };
struct Object {
  char name[24];  // Zero-terminated.
  ObjectRole role;
  std::uint16_t material;
  std::uint16_t bone_count;  // At most kMaxBonesPerDraw.
  std::uint16_t bone[30];    // Palette: index into joints.
  std::uint16_t reserved;
  std::uint32_t first_version;  // Into versions (and fat_first).
  std::uint32_t version_count;
  std::uint32_t base_vertex_count;  // Versions first_version.. of these are the base mesh.
  std::uint32_t max_vertex_count;   // Live vertices at full resolution, at most 65535.
  std::uint32_t first_base_index;   // Into base_indices, in u16 units.
  std::uint32_t base_triangle_count;
  std::uint32_t max_triangle_count;  // At full resolution.
  std::uint32_t first_split;         // Into splits.
  std::uint32_t split_count;
  float center_m[3];  // Bounding sphere at rest.
  float radius_m;
};

// One version of a vertex. A vertex that takes part in a collapse has a version before and after.
struct Vertex {
  float position_m[3];
  std::int8_t normal[4];   // Signed normalised; [3]: ambient occlusion, 0 open .. 127 closed.
  std::uint16_t uv[2];     // Unsigned normalised; v runs downwards as texel rows are stored.
  std::uint8_t bone[4];    // Index into Object::bone.
  std::uint8_t weight[4];  // Sum 255.
};
static_assert(sizeof(Vertex) == 28);

// One step of detail, from coarse to fine: a vertex splits in two (up), or the two collapse into
// one (down). Applied by core/mesh/progressive.h, which keeps for every object live vertices in
// slots [0, n) and live triangles in [0, t). Its words in `split_data` are, in this order:
//   changed_count x {slot, version before}    slots whose version changes; after it is
//   first_version
//                                             + i. Position moved, so every wedge of it is here
//   added_vertices x {parent slot}            new slots n, n+1 with the versions that follow
//   added_triangles x {slot, slot, slot}      new triangles t, t+1, finer slots already in them
//   moved_count x {triangle}                  live triangles in which a parent slot becomes its new
//                                             slot (exactly one corner each)
// Versions count from Object::first_version, slots and triangles from the object's own 0.
// With kReorder the record instead permutes the live triangles, to keep the vertex cache of the GPU
// busy: all counts are 0 and the words are {t} followed by t x {place of it before}.
enum SplitFlags : std::uint8_t { kReorder = 1 };
struct Split {
  std::uint32_t data;           // First word, counted from the start of `split_data`.
  std::uint16_t first_version;  // Of changed_count + added_vertices versions.
  std::uint16_t moved_count;
  std::uint8_t changed_count;    // 0..2 (0: the vertex that stays is locked)
  std::uint8_t added_vertices;   // 1..2 (2: along a texture seam)
  std::uint8_t added_triangles;  // 1..2 (1: at a border)
  std::uint8_t flags;
};
static_assert(sizeof(Split) == 12);

// A piece of a face animation table (FAT): FAP `fap` drives the moves that name this channel by
//   c = clamp((value - from) / (to - from), 0, 1)   with values in the FAP's own unit.
// A piecewise-linear FAT of n intervals is n channels: each adds the further displacement of its
// interval. Negative movements run from 0 to a negative `to`. When `partner` is not 0 the channel
// is a correction for a combination: c is multiplied by the same ramp of FAP `partner`.
struct Channel {
  std::uint16_t fap;
  std::uint16_t partner;
  float from, to;
  float partner_from, partner_to;
};

// What a channel does to a vertex version when its c is 1. Displacement = d * kMoveStep_m.
struct Move {
  std::uint16_t channel;
  std::int16_t d[3];
  std::int8_t normal[3];  // Change of the normal, in 1/127.
  std::int8_t reserved;
};
static_assert(sizeof(Move) == 12);
inline constexpr float kMoveStep_m = 2e-6f;  // +-65 mm in steps of 2 micrometres.

// FAP interpolation, MPEG-4's FIT node (ISO/IEC 14496-1) as data: what a stream leaves out is
// computed from what it sends. A rule is an edge of the FIT's graph, from the FAPs that its terms
// name to the receiver: a rational polynomial,
//   receiver = (sum of numerator terms) / (sum of denominator terms, or 1 where there are none),
// a term being coefficient * fap[0]^power[0] * fap[1]^power[1] in the FAPs' own units. Rules for
// one receiver stand in order of preference. The standard's nodes are groups of FAPs; here each FAP
// is its own node and a node's functions are rules one by one.
inline constexpr std::size_t kFitNumerators = 4, kFitDenominators = 2, kFitFactors = 2;
inline constexpr std::size_t kMaxFitRules = 256;
struct FitTerm {
  float coefficient;
  std::uint8_t fap[kFitFactors];    // 3..68; 0: no such factor.
  std::uint8_t power[kFitFactors];  // 1..3 where there is a FAP, else 0.
};
struct FitRule {
  std::uint8_t receiver;           // 3..68, no sender of its own.
  std::uint8_t numerator_count;    // 1..kFitNumerators; together they name at least one FAP.
  std::uint8_t denominator_count;  // 0..kFitDenominators
  std::uint8_t reserved;
  FitTerm numerator[kFitNumerators];
  FitTerm denominator[kFitDenominators];
};
static_assert(sizeof(FitTerm) == 8 && sizeof(FitRule) == 52);

// An MPEG-4 feature point (FDP). Its vertex is locked: it lives, unmoved, at every level of detail.
inline constexpr std::uint16_t kNoObject = 0xFFFF;
// Group of our own: where a sole stands, rolls over the heel and over the toes. Index 1..4 left
// heel back, heel, toe, toe tip; 5..8 right. Joint points, but with their own position.
inline constexpr std::uint8_t kSoleGroup = 20;
struct FeaturePoint {
  std::uint8_t group, index;  // "2.10" is {2, 10}.
  std::uint16_t object;       // kNoObject: the point is the centre of joint `vertex`.
  std::uint32_t vertex;       // Base vertex slot of the object, or joint.
  float position_m[3];        // At rest.
};

}  // namespace caryatid::pack
