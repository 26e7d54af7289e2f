// SPDX-License-Identifier: BSD-3-Clause
// Maps for tests: drawn as text, random, or read from the real maps of the data folder, if there is one.
#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "core/occupancy_grid.hpp"
#include "core/random.hpp"
#include "tests/project.hpp"

namespace waitpoint::test {

/// '#' occupied, '?' unknown, anything else free; the first line is the top row.
inline OccupancyGrid drawn_map(const std::vector<std::string>& rows, double resolution_m) {
  const int width = static_cast<int>(rows.front().size()), height = static_cast<int>(rows.size());
  OccupancyGrid grid(width, height, resolution_m, {});
  for (CellIndex at; at.y < height; ++at.y) {
    for (at.x = 0; at.x < width; ++at.x) {
      const char c = rows[static_cast<std::size_t>(height - 1 - at.y)][static_cast<std::size_t>(at.x)];
      grid[at] = c == '#' ? Cell::occupied : c == '?' ? Cell::unknown : Cell::free;
    }
  }
  return grid;
}

/// Each cell is occupied with probability `density`.
inline OccupancyGrid random_map(std::int32_t width, std::int32_t height, double density, std::uint64_t seed) {
  OccupancyGrid grid(width, height, 0.05, {});
  const RandomStream random(seed, "test", "map");
  for (std::int32_t i = 0; i < width * height; ++i) {
    const bool occupied = random.uniform(static_cast<std::uint64_t>(i)) < density;
    grid[{i % width, i / width}] = occupied ? Cell::occupied : Cell::free;
  }
  return grid;
}

/// Reads maps/`name`.pgm (binary, 8 bits) of the data folder with the resolution and thresholds of its YAML; nothing if
/// there is no such folder.
inline std::optional<OccupancyGrid> real_map(const std::string& name, double resolution_m, double free_below) {
  const std::optional<std::string> folder = data_folder();
  if (!folder) return std::nullopt;
  std::ifstream file(*folder + "/maps/" + name + ".pgm", std::ios::binary);
  if (!file) return std::nullopt;
  std::string magic, word;
  file >> magic;
  std::vector<int> numbers;
  while (numbers.size() < 3 && file >> word) {
    if (word[0] == '#') {
      std::getline(file, word);
    } else {
      numbers.push_back(std::atoi(word.c_str()));
    }
  }
  file.get();
  OccupancyGrid grid(numbers.at(0), numbers.at(1), resolution_m, {});
  std::string pixels(static_cast<std::size_t>(grid.width()) * static_cast<std::size_t>(grid.height()), '\0');
  file.read(pixels.data(), static_cast<std::streamsize>(pixels.size()));
  std::size_t next = 0;
  for (int y = grid.height() - 1; y >= 0; --y) {
    for (int x = 0; x < grid.width(); ++x) {
      const double p = (255 - static_cast<unsigned char>(pixels[next++])) / 255.0;
      grid[{x, y}] = p > 0.65 ? Cell::occupied : p < free_below ? Cell::free : Cell::unknown;
    }
  }
  return grid;
}

}  // namespace waitpoint::test
