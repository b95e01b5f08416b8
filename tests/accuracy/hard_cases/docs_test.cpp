#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <iostream>
#include <sstream>
#include <string>

#include "hard_cases/hard_case.hpp"

// docs/accuracy.md shows the table that HardCases checks cell by cell. With QUADRILLE_UPDATE_DOCS
// set, the page is rewritten instead of compared.

namespace quadrille::accuracy {
namespace {

const std::string page = QUADRILLE_DOCS_DIR "/accuracy.md";
const std::string begin = "<!-- hard cases: written by quadrille_accuracy_tests -->\n";
const std::string end = "<!-- end of hard cases -->\n";

TEST(HardCasesInTheDocs, AreThoseOfTheTests) {
    std::cout << outcomeTable();
    std::ifstream file(page);
    std::ostringstream text;
    text << file.rdbuf();
    std::string docs = text.str();
    const auto from = docs.find(begin);
    const auto to = docs.find(end);
    ASSERT_NE(from, std::string::npos) << page << " lacks the line " << begin;
    ASSERT_NE(to, std::string::npos) << page << " lacks the line " << end;
    const auto first = from + begin.size();
    ASSERT_LE(first, to);
    if (std::getenv("QUADRILLE_UPDATE_DOCS") != nullptr) {
        docs.replace(first, to - first, outcomeTable());
        std::ofstream(page) << docs;
        return;
    }
    EXPECT_EQ(docs.substr(first, to - first), outcomeTable())
        << "run the test with QUADRILLE_UPDATE_DOCS=1";
}

}  // namespace
}  // namespace quadrille::accuracy
