#include "bench/table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iostream>

#include <quadrille/error.hpp>

#include "bench/machine.hpp"

namespace quadrille::bench {

namespace {

std::ofstream open(const std::string& name, std::ios::openmode mode) {
    std::ofstream file(name, mode);
    if (!file) throw Error(name + ": cannot be written");
    return file;
}

void writeMachine(std::ostream& out, std::string_view prefix) {
    for (const auto& [key, value] : describeMachine()) {
        out << prefix << key << ": " << value << '\n';
    }
}

void writeNotes(std::ostream& out, std::string_view prefix, const std::vector<std::string>& notes) {
    for (const std::string& note : notes) out << prefix << note << '\n';
}

std::string quoted(const std::string& cell) {
    if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
    std::string result = "\"";
    for (const char c : cell) result.append(c == '"' ? 2 : 1, c);
    return result + '"';
}

}  // namespace

void Table::add(std::vector<std::string> row) {
    if (row.size() != columns_.size()) throw Error("table: a row of the wrong length");
    rows_.push_back(std::move(row));
}

void Table::writeText(std::ostream& out) const {
    std::vector<std::size_t> widths;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
        widths.push_back(columns_[c].size());
        for (const auto& row : rows_) widths[c] = std::max(widths[c], row[c].size());
    }
    const auto write = [&](const std::vector<std::string>& row) {
        for (std::size_t c = 0; c < row.size(); ++c) {
            out << row[c];
            if (c + 1 < row.size()) out << std::string(widths[c] - row[c].size() + 2, ' ');
        }
        out << '\n';
    };
    write(columns_);
    for (const auto& row : rows_) write(row);
}

void Table::writeCsv(std::ostream& out) const {
    const auto write = [&](const std::vector<std::string>& row) {
        for (std::size_t c = 0; c < row.size(); ++c) out << (c > 0 ? "," : "") << quoted(row[c]);
        out << '\n';
    };
    write(columns_);
    for (const auto& row : rows_) write(row);
}

void Table::writeMarkdown(std::ostream& out) const {
    const auto write = [&](const std::vector<std::string>& row) {
        for (const std::string& cell : row) out << "| " << cell << ' ';
        out << "|\n";
    };
    write(columns_);
    write(std::vector<std::string>(columns_.size(), "---"));
    for (const auto& row : rows_) write(row);
}

std::string number(double value) {
    char text[64];
    const bool large = std::abs(value) >= 1000 && std::abs(value) < 1e15;
    const auto end =
        large ? std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, 0)
              : std::to_chars(text, text + sizeof text, value, std::chars_format::general, 4);
    return {text, end.ptr};
}

std::string hexadecimal(std::uint64_t value) {
    char text[16];
    const auto end = std::to_chars(text, text + sizeof text, value, 16);
    const std::string digits(text, end.ptr);
    return std::string(16 - digits.size(), '0') + digits;
}

void checkWritable(const TableFiles& files) {
    for (const std::string& name : {files.csv, files.markdown}) {
        if (!name.empty()) open(name, std::ios::app);
    }
}

void publish(const Table& table, const TableFiles& files, const std::vector<std::string>& notes) {
    writeMachine(std::cout, "# ");
    table.writeText(std::cout);
    writeNotes(std::cout, "", notes);
    if (!files.csv.empty()) {
        std::ofstream file = open(files.csv, std::ios::trunc);
        writeMachine(file, "# ");
        writeNotes(file, "# ", notes);
        table.writeCsv(file);
    }
    if (!files.markdown.empty()) {
        std::ofstream file = open(files.markdown, std::ios::trunc);
        writeMachine(file, "- ");
        file << '\n';
        table.writeMarkdown(file);
        if (!notes.empty()) file << '\n';
        writeNotes(file, "- ", notes);
    }
}

}  // namespace quadrille::bench
