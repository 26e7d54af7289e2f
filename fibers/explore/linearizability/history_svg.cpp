// SPDX-License-Identifier: BSD-3-Clause
#include <string_view>

#include "core/xml_text.hpp"
#include "fibers/explore/linearizability/history_columns.hpp"
#include "fibers/explore/linearizability/history_picture.hpp"

namespace waitpoint::exploration {
namespace {

// In pixels; a character's width is an estimate for the font.
constexpr std::size_t row_height = 22, bar_height = 16, column_width = 14, margin = 10, letter_width = 8;

// `name="4"`, the form of all attributes here.
std::string attribute(std::string_view name, std::size_t value) {
  return " " + std::string(name) + "=\"" + std::to_string(value) + "\"";
}

std::string text_at(std::size_t x, std::size_t y, std::string_view text, std::string_view style = "") {
  return "<text" + attribute("x", x) + attribute("y", y) + std::string(style) + ">" + xml_escaped(text) + "</text>\n";
}

std::string_view fill_of(const HistoryPicture& picture, std::size_t row) {
  if (picture.bad == row) return "#d62728";                     // red
  return picture.rows[row].place == 0 ? "#c7c7c7" : "#9ecae1";  // grey, blue
}

}  // namespace

std::string to_svg(const HistoryPicture& picture) {
  const HistoryColumns columns(picture);
  std::size_t letters = 0;
  const auto title = [](const HistoryRow& row) { return row.task + ": " + row.operation; };
  for (const HistoryRow& row : picture.rows) letters = std::max(letters, title(row).size());
  const std::size_t bars = margin + letters * letter_width + margin;  // their left edge
  const auto x = [&](std::uint32_t event) { return bars + columns[event] * column_width; };
  const std::size_t width = bars + (columns.count() + 1) * column_width + margin;
  const std::size_t height = 2 * margin + (picture.rows.size() + 1) * row_height;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", width) +
                    attribute("height", height) + " font-family=\"monospace\" font-size=\"12\">\n";
  for (std::size_t i = 0; i < picture.rows.size(); ++i) {
    const HistoryRow& row = picture.rows[i];
    const std::size_t top = margin + i * row_height, base = top + bar_height - 3, left = x(row.interval.invoked);
    svg += text_at(margin, base, title(row));
    svg += "<rect" + attribute("x", left) + attribute("y", top) +
           attribute("width", x(row.interval.responded) + column_width - left) + attribute("height", bar_height) +
           " rx=\"3\" fill=\"" + std::string(fill_of(picture, i)) + "\"/>\n";
    if (row.place != 0) svg += text_at(left + 4, base, std::to_string(row.place));
  }
  if (picture.bad) {
    const std::size_t end = x(picture.rows[*picture.bad].interval.responded);
    const std::size_t bottom = margin + picture.rows.size() * row_height;
    svg += "<line" + attribute("x1", end) + attribute("y1", margin) + attribute("x2", end) + attribute("y2", bottom) +
           " stroke=\"#d62728\" stroke-dasharray=\"4 3\"/>\n";
    svg += text_at(end, bottom + bar_height, "end of the longest linearizable prefix", " text-anchor=\"end\"");
  }
  return svg + "</svg>\n";
}

}  // namespace waitpoint::exploration
