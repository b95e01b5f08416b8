#include "app/output_file.hpp"

#include <array>
#include <charconv>
#include <iostream>

#include "app/standard_streams.hpp"

namespace quadrille::app {

namespace {

template <class Real>
std::string shortest(Real value) {
    std::array<char, 32> text{};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end};
}

}  // namespace

OutputFile::OutputFile(const std::string& name) {
    if (name == "-") {
        requireStdout();
    } else {
        file_.emplace(name, WholeFile::Special::WriteTo);
    }
}

std::ostream& OutputFile::stream() { return file_ ? file_->stream() : std::cout; }

void OutputFile::commit() {
    if (file_) {
        file_->commit();
    } else {
        finishStdout();
    }
}

std::string exact(double value) { return shortest(value); }
std::string exact(float value) { return shortest(value); }

}  // namespace quadrille::app
