// The table of outcomes in docs/accuracy.md.

#include <sstream>

#include "hard_cases/hard_case.hpp"

namespace quadrille::accuracy {

namespace {

std::string cell(const Texts& texts) {
    if (texts.inDouble == texts.inFloat) return texts.inDouble;
    return texts.inDouble + "; float: " + texts.inFloat;
}

}  // namespace

std::string outcomeTable() {
    std::ostringstream out;
    out << "| case | baseline | impulse | continuous |\n|---|---|---|---|\n";
    for (const HardCase& c : hardCases()) {
        out << "| " << c.title;
        for (const Law law : {Law::Baseline, Law::Impulse, Law::Continuous}) {
            out << " | " << cell(c.expected(law));
        }
        out << " |\n";
    }
    return out.str();
}

}  // namespace quadrille::accuracy
