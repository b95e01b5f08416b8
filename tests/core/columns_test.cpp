// The kinds of columns: what a row holds after rows were added, moved, cut off and permuted. Each
// kind is used at random beside a plain vector.

#include "core/columns.hpp"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <quadrille/random.hpp>

#include "shuffled.hpp"

namespace quadrille {
namespace {

template <class T>
std::vector<T> permuted(const std::vector<T>& values, const Order& order) {
    std::vector<T> result;
    for (const std::uint32_t row : order) result.push_back(values[row]);
    return result;
}

/// Takes out rows as BodyStore does: rows that stay move down in order, then the rest is cut off.
template <class Column, class T>
void compact(Column& column, std::vector<T>& model, Random& random) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < model.size(); ++i) {
        if (random.integer(0, 2) == 0) continue;
        if (kept != i) column.move(i, kept);
        model[kept++] = model[i];
    }
    column.shrink(kept);
    model.resize(kept);
}

// ---- Column: one number while all rows agree

TEST(Column, StaysOneNumberWhileAllRowsAgree) {
    Column<double> column;
    for (std::size_t i = 0; i < 100; ++i) {
        column.grow();
        column.set(i, 3);
    }
    column.set(50, 3);
    EXPECT_TRUE(column.view().uniform());
    EXPECT_EQ(column.view().common, 3);
    EXPECT_EQ(column.size(), 100u);
    EXPECT_EQ(column.bytes(), 0u);
    column.shrink(0);
    column.grow();
    column.set(0, 8);
    EXPECT_TRUE(column.view().uniform());
    EXPECT_EQ(column[0], 8);
}

TEST(Column, ExpandsAtTheFirstValueThatDiffers) {
    Column<double> pushed;
    for (const double value : {3, 3, 4, 3}) {
        pushed.grow();
        pushed.set(pushed.size() - 1, value);
    }
    Column<double> set;
    for (std::size_t i = 0; i < 4; ++i) {
        set.grow();
        set.set(i, 3);
    }
    set.set(2, 4);
    for (const auto* column : {&pushed, &set}) {
        const auto view = column->view();
        ASSERT_FALSE(view.uniform());
        ASSERT_EQ(view.values.size(), 4u);
        EXPECT_EQ(column->size(), 4u);
        for (const std::size_t row : {0u, 1u, 3u}) EXPECT_EQ(view[row], 3);
        EXPECT_EQ(view[2], 4);
        EXPECT_EQ((*column)[2], 4);
    }
    pushed.move(2, 0);
    pushed.shrink(2);
    EXPECT_EQ(pushed.size(), 2u);
    EXPECT_EQ(pushed[0], 4);
    EXPECT_EQ(pushed[1], 3);
}

TEST(Column, AgreesWithAVectorUnderRandomUse) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        Column<int> column;
        std::vector<int> model;
        // With one value to choose from it stays uniform, with two it soon is not.
        const int values = static_cast<int>(random.integer(1, 2));
        for (int i = 0; i < 400; ++i) {
            const auto draw = [&] { return static_cast<int>(random.integer(1, values)); };
            const std::int64_t action = random.integer(0, 20);
            if (action < 14 || model.empty()) {
                model.push_back(draw());
                column.grow();
                column.set(model.size() - 1, model.back());
            } else if (action < 18) {
                const auto row = static_cast<std::size_t>(random.integer(0, model.size() - 1));
                model[row] = draw();
                column.set(row, model[row]);
            } else if (action < 20) {
                const Order order = shuffled(model.size(), random);
                column.permute(order);
                model = permuted(model, order);
            } else {
                compact(column, model, random);
            }
            ASSERT_EQ(column.size(), model.size());
            for (std::size_t row = 0; row < model.size(); ++row) ASSERT_EQ(column[row], model[row]);
            ASSERT_TRUE(values == 2 || column.view().uniform());
        }
    }
}

// ---- PlainColumn

TEST(PlainColumn, AgreesWithAVectorUnderRandomUse) {
    Random random(1);
    PlainColumn<int> column;
    std::vector<int> model;
    for (int i = 0; i < 500; ++i) {
        column.grow();
        EXPECT_EQ(column[model.size()], 0) << "a new row is zero until it is set";
        column.set(model.size(), i);
        model.push_back(i);
        if (i % 50 == 25) {
            const Order order = shuffled(model.size(), random);
            column.permute(order);
            model = permuted(model, order);
        }
        if (i % 50 == 49) compact(column, model, random);
        ASSERT_EQ(column.stored(), model);
    }
    EXPECT_GE(column.bytes(), model.size() * sizeof(int));
}

// ---- OptionalColumn

TEST(OptionalColumn, HoldsNothingUntilItIsKept) {
    OptionalColumn<int> column;
    for (int i = 0; i < 5; ++i) column.grow();
    column.move(3, 1);
    column.permute(Order{4, 3, 2, 1, 0});
    column.shrink(4);
    EXPECT_FALSE(column.kept());
    EXPECT_TRUE(column.view().empty());
    EXPECT_EQ(column.bytes(), 0u);
}

struct Seven {
    int value = 7;
    bool operator==(const Seven&) const = default;
};

TEST(OptionalColumn, BeginsWithTheInitialValueInEveryRowOldOrNew) {
    using Sevens = std::vector<Seven>;
    OptionalColumn<Seven> column;
    column.keep(true, 3);
    EXPECT_EQ(column.stored(), (Sevens{{7}, {7}, {7}}));
    column.view()[1] = {1};
    column.keep(true, 3);  // is kept already: nothing is lost
    EXPECT_EQ(column.stored(), (Sevens{{7}, {1}, {7}}));
    column.grow();
    EXPECT_EQ(column.stored(), (Sevens{{7}, {1}, {7}, {7}}));
    column.permute(Order{1, 0, 3, 2});
    EXPECT_EQ(column.stored(), (Sevens{{1}, {7}, {7}, {7}}));
    column.move(0, 2);
    column.shrink(3);
    EXPECT_EQ(column.stored(), (Sevens{{1}, {7}, {1}}));
    column.keep(false, 3);
    EXPECT_TRUE(column.stored().empty());
    EXPECT_EQ(column.bytes(), 0u);
    column.keep(true, 2);
    EXPECT_EQ(column.stored(), (Sevens{{7}, {7}})) << "what was kept before is forgotten";
    column.store({{2}});
    column.grow();
    EXPECT_EQ(column.stored(), (Sevens{{2}, {7}})) << "as a snapshot brings it";
}

// ---- CreationColumn

Order numbersOf(const CreationColumn& column) {
    Order numbers;
    for (std::size_t row = 0; row < column.size(); ++row) numbers.push_back(column[row]);
    return numbers;
}

CreationColumn columnOf(std::size_t rows) {
    CreationColumn column;
    for (std::size_t i = 0; i < rows; ++i) column.grow();
    return column;
}

TEST(CreationColumn, StoresNothingWhileRowsLieAsTheyWereCreated) {
    CreationColumn column = columnOf(6);
    EXPECT_EQ(numbersOf(column), (Order{0, 1, 2, 3, 4, 5}));
    column.move(2, 1);
    column.move(5, 2);
    column.shrink(3);
    EXPECT_EQ(numbersOf(column), (Order{0, 1, 2}));
    column.grow();
    EXPECT_EQ(numbersOf(column), (Order{0, 1, 2, 3}));
    EXPECT_TRUE(column.view().isRowOrder());
    EXPECT_EQ(column.bytes(), 0u);
}

TEST(CreationColumn, KeepsTheNumbersOfRowsThatArePermuted) {
    CreationColumn column = columnOf(4);
    column.permute(Order{2, 0, 3, 1});
    EXPECT_FALSE(column.view().isRowOrder());
    EXPECT_EQ(numbersOf(column), (Order{2, 0, 3, 1}));
    column.permute(Order{0, 3, 1, 2});
    EXPECT_EQ(numbersOf(column), (Order{2, 1, 0, 3}));
    column.grow();
    EXPECT_EQ(column[4], 4u) << "a new row is the last of all";
    column.move(4, 1);  // row 1, number 1, goes
    column.shrink(4);
    EXPECT_EQ(numbersOf(column), (Order{2, 4, 0, 3}));
    column.grow();
    EXPECT_EQ(column[4], 5u) << "no number is given twice";
}

TEST(CreationColumn, ForgetsTheNumbersWhenRowsLieInOrderAgain) {
    CreationColumn column = columnOf(4);
    column.permute(Order{2, 0, 3, 1});
    column.permute(Order{1, 3, 0, 2});
    EXPECT_TRUE(column.view().isRowOrder());
    EXPECT_EQ(numbersOf(column), (Order{0, 1, 2, 3}));
    column.grow();
    EXPECT_EQ(column[4], 4u);
    EXPECT_EQ(column.next(), 5u);
}

TEST(CreationColumn, CountsAgainFromTheRowsWhenNumbersRunOut) {
    CreationColumn column;
    column.store({7, 2, CreationColumn::mostNumbers - 1}, 3, CreationColumn::mostNumbers);
    column.grow();
    EXPECT_EQ(numbersOf(column), (Order{1, 0, 2, 3}));
    EXPECT_EQ(column.next(), 4u);
}

TEST(CreationColumn, AgreesWithTheListOfAllCreatedUnderRandomUse) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        CreationColumn column;
        std::vector<int> created;  // what was created in each row: 0, 1, 2, ...
        int next = 0;
        for (int i = 0; i < 300; ++i) {
            const std::int64_t action = random.integer(0, 9);
            if (action < 7) {
                column.grow();
                created.push_back(next++);
            } else if (action < 9) {
                const Order order = shuffled(created.size(), random);
                column.permute(order);
                created = permuted(created, order);
            } else {
                compact(column, created, random);
            }
            // Not the numbers but their order is what is promised.
            ASSERT_EQ(column.size(), created.size());
            for (std::size_t p = 0; p < created.size(); ++p) {
                ASSERT_LT(column[p], column.next());
                for (std::size_t q = 0; q < created.size(); ++q) {
                    ASSERT_EQ(column[p] < column[q], created[p] < created[q]);
                }
            }
        }
    }
}

}  // namespace
}  // namespace quadrille
