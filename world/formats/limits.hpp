// SPDX-License-Identifier: BSD-3-Clause
// Limits of files. Anything beyond is bad input, so that no file, however short, takes all memory.
#pragma once

#include <cstddef>

namespace waitpoint::world {

/// Obstacles per file, after merging.
inline constexpr std::size_t obstacle_count_max = std::size_t{1} << 20;
/// Coordinates and sizes.
inline constexpr double coordinate_m_max = 1e5;
/// Angles: a greater one is probably in other units.
inline constexpr double angle_rad_max = 1e4;
/// Bytes of a file that is read line by line, and of files whose parse trees are many times as large: XML, Stage worlds
/// (with everything they include), and a map's YAML.
inline constexpr std::size_t text_bytes_max = std::size_t{1} << 26;
inline constexpr std::size_t tree_bytes_max = std::size_t{1} << 24;
inline constexpr std::size_t stage_bytes_max = std::size_t{1} << 22;
inline constexpr std::size_t yaml_bytes_max = std::size_t{1} << 20;
/// Triangles, unscaled coordinates and bytes of a mesh file.
inline constexpr std::size_t triangle_count_max = std::size_t{1} << 20;
inline constexpr double mesh_coordinate_max = 1e9;
/// Meshes named by one file; together they have at most triangle_count_max triangles.
inline constexpr std::size_t mesh_count_max = 10'000;
inline constexpr std::size_t mesh_bytes_max = std::size_t{1} << 28;
/// Occupied cells of an octree, before merging, and its bytes.
inline constexpr std::size_t octree_cell_count_max = std::size_t{1} << 22;
inline constexpr std::size_t octree_bytes_max = std::size_t{1} << 26;
/// Bytes of an image.
inline constexpr std::size_t image_bytes_max = std::size_t{1} << 30;

}  // namespace waitpoint::world
