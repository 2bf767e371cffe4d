#pragma once
// Between what the scene shows and what the budget controller asks: needs and fixed levels.
#include <array>
#include <span>
#include <string>

#include "core/agent/person.h"
#include "core/lod/frame.h"
#include "core/scene/draw_list.h"

namespace caryatid::app {

// --lod: "auto" leaves `out` alone; "N" shares N triangles among all objects by size;
// "head=N,body=N" gives them to the objects of these roles, the others stay whole. False: one line
// in out_error.
bool parse_levels(const std::string& text, const pack::View& pack, std::span<std::uint32_t> out,
                  std::string* out_error);

// What one object needs in the coming frame, judged by the last draw list.
lod::ObjectNeed object_need(const pack::Object& object, const scene::DrawList& last,
                            const agent::Person& person, std::size_t index, std::uint32_t width,
                            std::uint32_t height, bool expressive);

// Fragments of the last draw list at full scale, overdraw included. An estimate from bounding
// spheres.
float shaded_pixels(const agent::Person& person, const scene::DrawList& list, std::uint32_t width,
                    std::uint32_t height);

}  // namespace caryatid::app
