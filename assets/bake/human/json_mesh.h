#pragma once
// The three.js JSON 3.1 meshes of the package: quads with a material and texture coordinates.
// Internal to the room.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "assets/bake/human/makehuman.h"

namespace caryatid::bake {

// Object members keep the order of the file: the list of targets is an object whose order counts.
using Json = nlohmann::ordered_json;

inline constexpr float kMetresPerDecimetre = 0.1f;

// Throws std::runtime_error "FILE: what" when it cannot be opened or is not JSON.
Json read_json(const std::filesystem::path& file);

std::vector<Vec3> read_positions(const Json& mesh);
std::vector<Vec2> read_uvs(const Json& mesh);
std::vector<Quad> read_quads(const Json& mesh, std::size_t vertex_count, std::size_t uv_count);
// Skin indices of the files count `X____head` bones, which alternate with the bones themselves.
std::vector<Influence> read_influences(const Json& mesh, std::size_t vertex_count,
                                       std::size_t bone_count);
Licence read_licence(const Json& mesh, std::string source);

}  // namespace caryatid::bake
