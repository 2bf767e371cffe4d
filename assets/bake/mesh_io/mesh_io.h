#pragma once
// Triangle meshes of other programs: Wavefront OBJ, OFF, Stanford PLY (text, and binary of either
// byte order). Positions and faces only; polygons become fans. Every byte is hostile.
#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "assets/bake/files/files.h"
#include "assets/bake/simplify/edge_collapse.h"

namespace caryatid::bake {

// "NAME:LINE: what is wrong; what to do", for the user as it stands.
struct MeshError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class MeshFormat { obj, off, ply };
// By extension; throws MeshError when it is none of them.
MeshFormat format_of(const std::filesystem::path& path);

// Reads what is written, faults and all: repair_surface() is the next step. Indices are checked,
// counts are held against the bytes that are there before memory is taken, positions are finite.
// Throws MeshError with the line or element that offends.
Surface parse_mesh(std::string_view bytes, MeshFormat format, const std::string& name);
Surface read_mesh(const std::filesystem::path& path);

// Positions in the shortest form that reads back to the same double; PLY is binary, in double.
std::string format_mesh(const Surface& surface, MeshFormat format);

}  // namespace caryatid::bake
