// What `deltav uncertainty fixtures/sae-980025-uncertain.toml` computes, as a vectorised C++ program: a yardstick for the program's speed, as
// uncertainty.py is one.
//
//     g++ -std=c++20 -O3 -march=native -mprefer-vector-width=512 -ffast-math -fopenmp-simd benches/uncertainty.cpp -o target/uncertainty-cpp
//     target/uncertainty-cpp [SAMPLES]
//
// Needs GCC and a C library with libmvec, whose functions the loops over BLOCK samples call: one instruction then takes as many samples as the CPU's
// registers hold. Draws all 31 numbers, solves each sample in closed form (docs/theory.md, sections 2 to 5) and prints mean, standard deviation and the
// 2.5, 50 and 97.5 % quantiles of the same nine outputs (SI). One thread. benches/README.md says what to compare.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <numbers>
#include <vector>

namespace {

constexpr double INCH = 0.0254, FOOT = 0.3048;
constexpr double POUND = 0.45359237;            // kg
constexpr double POUND_FORCE = POUND * 9.80665; // N
constexpr double INERTIA = POUND_FORCE * FOOT;  // lb ft s² in kg·m²
constexpr double MPH = 0.44704;
constexpr double DEGREE = std::numbers::pi / 180.0;
const double ROOT_POUND_FORCE = std::sqrt(POUND_FORCE); // lb^0.5 in √N
constexpr double NORMAL_95 = 1.959963984540054; // half the width that holds 95 % of a normal distribution, in its standard deviations

// Samples that are solved together: their columns stay in the nearest cache.
constexpr int BLOCK = 128;

// A number of each sample of a block.
struct alignas(64) Column {
    double at[BLOCK];
};

// A loop over the samples of a block; its body has no branches and calls only what libmvec has.
#define EACH _Pragma("omp simd") for (int i = 0; i < BLOCK; i++)

// The number at `index` of the SplitMix64 sequence that starts at `key`.
inline uint64_t bits(uint64_t key, uint64_t index) {
    uint64_t z = key + 0x9E3779B97F4A7C15 * (index + 1);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return z ^ (z >> 31);
}

// Draws numbers for a block of samples.
class Draws {
public:
    // The next input of the block that begins at the sample `first` is the first one.
    void begin(uint64_t first) {
        first_ = first;
        input_ = 0;
    }

    Column uniform(double low, double high) {
        Column x = shares();
        EACH x.at[i] = low + (high - low) * x.at[i];
        return x;
    }

    Column triangular(double low, double mode, double high) {
        const double width = high - low, share = (mode - low) / width;
        Column x = shares();
        EACH {
            const double u = x.at[i];
            const double rising = low + std::sqrt(u * width * (mode - low));
            const double falling = high - std::sqrt((1.0 - u) * width * (high - mode));
            x.at[i] = u < share ? rising : falling;
        }
        return x;
    }

    // By Box and Muller: two numbers from each share of the first half of the block and its counterpart of the second half.
    Column normal(double mean, double sd) {
        constexpr int HALF = BLOCK / 2;
        const Column u = shares();
        Column sines, cosines, x;
        // Two loops, as GCC makes one call of both for a single one, which libmvec does not have.
        _Pragma("omp simd") for (int i = 0; i < HALF; i++) sines.at[i] = std::sin(2.0 * std::numbers::pi * u.at[HALF + i]);
        _Pragma("omp simd") for (int i = 0; i < HALF; i++) cosines.at[i] = std::cos(2.0 * std::numbers::pi * u.at[HALF + i]);
        _Pragma("omp simd") for (int i = 0; i < HALF; i++) {
            const double radius = sd * std::sqrt(-2.0 * std::log(u.at[i]));
            x.at[i] = mean + radius * cosines.at[i];
            x.at[HALF + i] = mean + radius * sines.at[i];
        }
        return x;
    }

    // Normal, drawn again where not above zero.
    Column positive(double mean, double sd) {
        Column x = normal(mean, sd);
        double least = mean;
        EACH least = x.at[i] < least ? x.at[i] : least;
        while (least <= 0.0) {
            const Column again = normal(mean, sd);
            least = mean;
            for (int i = 0; i < BLOCK; i++) {
                x.at[i] = x.at[i] <= 0.0 ? again.at[i] : x.at[i];
                least = std::min(least, x.at[i]);
            }
        }
        return x;
    }

    // Normal, 95 % of it within a share of the mean.
    Column within(double mean, double share) { return positive(mean, share * mean / NORMAL_95); }

private:
    // In (0, 1): the middle of one of 2⁵² equal cells.
    Column shares() {
        const uint64_t key = bits(1, input_++);
        Column u;
        EACH u.at[i] = (static_cast<double>(static_cast<int64_t>(bits(key, first_ + i) >> 12)) + 0.5) * 0x1p-52;
        return u;
    }

    uint64_t first_ = 0;
    uint64_t input_ = 0;
};

struct Crush {
    double width;                 // in
    std::array<double, 6> depths; // in
    double d0, d1;                // lb^0.5, lb^0.5/ft
};

constexpr Crush CRUSH[] = {
    {65, {21.3, 20.3, 13.8, 11.3, 5.3, 4.8}, 35, 115},
    {84, {3.0, 15.8, 13.5, 6.7, 3.3, 5.0}, 30, 77.5},
};

// E = Σ w [A (C₁ + C₂)/2 + B (C₁² + C₁C₂ + C₂²)/6 + G]
void add_energy(Draws &draws, const Crush &crush, Column &energy) {
    const Column width = draws.positive(crush.width * INCH, 1.0 * INCH);
    std::array<Column, 6> depths;
    for (int station = 0; station < 6; station++) depths[station] = draws.positive(crush.depths[station] * INCH, 0.5 * INCH);
    const Column d0 = draws.within(crush.d0 * ROOT_POUND_FORCE, 0.20);
    const Column d1 = draws.within(crush.d1 * ROOT_POUND_FORCE / FOOT, 0.10);
    for (int station = 0; station < 5; station++) {
        const Column &first = depths[station], &second = depths[station + 1];
        EACH {
            const double a = d0.at[i] * d1.at[i], b = d1.at[i] * d1.at[i], g = d0.at[i] * d0.at[i] / 2.0;
            const double c1 = first.at[i], c2 = second.at[i], w = width.at[i] / 5.0;
            energy.at[i] += w * (a * (c1 + c2) / 2.0 + b * (c1 * c1 + c1 * c2 + c2 * c2) / 6.0 + g);
        }
    }
}

Column sin_of(const Column &angle) {
    Column sin;
    EACH sin.at[i] = std::sin(angle.at[i]);
    return sin;
}

Column cos_of(const Column &angle) {
    Column cos;
    EACH cos.at[i] = std::cos(angle.at[i]);
    return cos;
}

constexpr int OUTPUTS = 9;
constexpr const char *NAMES[OUTPUTS] = {
    "vehicle1.speed",       "vehicle1.delta_v",   "vehicle2.delta_v",   "vehicle1.pdof",          "vehicle2.pdof",
    "impact.closing_speed", "impact.energy_loss", "impact.normal_work", "impact.tangential_work",
};

// The outputs of a block, and of each of its samples 1 where it has an answer.
void solve(Draws &draws, std::array<Column, OUTPUTS> &outputs, Column &answered) {
    const Column m1 = draws.positive(3696 * POUND, 50 * POUND), j1 = draws.within(2437 * INERTIA, 0.10);
    const Column m2 = draws.positive(3413 * POUND, 50 * POUND), j2 = draws.within(2165 * INERTIA, 0.10);
    const Column h1 = draws.normal(180 * DEGREE, 3 * DEGREE), h2 = draws.normal(67 * DEGREE, 3 * DEGREE);
    const Column d1 = draws.positive(6.3 * FOOT, 3 * INCH), f1 = draws.normal(-22.4 * DEGREE, 3 * DEGREE);
    const Column d2 = draws.positive(3.8 * FOOT, 3 * INCH), f2 = draws.normal(-39 * DEGREE, 3 * DEGREE);
    const Column v2 = draws.triangular(8 * MPH, 10 * MPH, 12 * MPH);
    const Column crush_plane = draws.normal(-23 * DEGREE, 3 * DEGREE);
    const Column restitution = draws.uniform(0.2, 0.4);
    Column crush_energy = {};
    for (const Crush &crush : CRUSH) add_energy(draws, crush, crush_energy);

    Column to_contact1, to_contact2;
    EACH to_contact1.at[i] = h1.at[i] + f1.at[i];
    EACH to_contact2.at[i] = h2.at[i] + f2.at[i];
    const Column sin_h1 = sin_of(h1), cos_h1 = cos_of(h1), sin_h2 = sin_of(h2), cos_h2 = cos_of(h2);
    const Column sin_c1 = sin_of(to_contact1), cos_c1 = cos_of(to_contact1);
    const Column sin_c2 = sin_of(to_contact2), cos_c2 = cos_of(to_contact2);
    const Column sin_plane = sin_of(crush_plane), cos_plane = cos_of(crush_plane);
    Column directions[2][2];
    EACH {
        const double s1 = sin_h1.at[i], c1 = cos_h1.at[i], s2 = sin_h2.at[i], c2 = cos_h2.at[i];
        const double e = restitution.at[i];

        // Arms in the scene, the normal, arms along n and t.
        const double x1 = d1.at[i] * cos_c1.at[i], y1 = d1.at[i] * sin_c1.at[i];
        const double x2 = d2.at[i] * cos_c2.at[i], y2 = d2.at[i] * sin_c2.at[i];
        const double towards = (x2 - x1) * cos_plane.at[i] + (y2 - y1) * sin_plane.at[i];
        const double nx = std::copysign(1.0, towards) * cos_plane.at[i], ny = std::copysign(1.0, towards) * sin_plane.at[i];
        const double n1 = x1 * nx + y1 * ny, t1 = y1 * nx - x1 * ny;
        const double n2 = x2 * nx + y2 * ny, t2 = y2 * nx - x2 * ny;

        // K
        const double by_m1 = 1.0 / m1.at[i], by_m2 = 1.0 / m2.at[i], by_j1 = 1.0 / j1.at[i], by_j2 = 1.0 / j2.at[i];
        const double k_nn = by_m1 + by_m2 + t1 * t1 * by_j1 + t2 * t2 * by_j2;
        const double k_tt = by_m1 + by_m2 + n1 * n1 * by_j1 + n2 * n2 * by_j2;
        const double k_nt = -(n1 * t1 * by_j1 + n2 * t2 * by_j2);
        const double by_det = 1.0 / (k_nn * k_tt - k_nt * k_nt);

        // u at the speed 0 of vehicle 1, and its slope; P_n = α x + β with x = −u_n
        const double w_n = c1 * nx + s1 * ny, w_t = s1 * nx - c1 * ny;
        const double r_n = -v2.at[i] * (c2 * nx + s2 * ny), r_t = -v2.at[i] * (s2 * nx - c2 * ny);
        const double slope = -w_t / w_n;
        const double touch = r_t + r_n * slope;
        const double beta = k_nt * touch * by_det;
        const double alpha = (k_tt * (1.0 + e) + k_nt * slope) * by_det;
        const double q = 2.0 * crush_energy.at[i] / (1.0 - e);
        const double x = (std::sqrt(beta * beta + 4.0 * alpha * q) - beta) / (2.0 * alpha);

        // The impact there.
        const double u_n = -x, u_t = touch + x * slope;
        const double p_n = (-k_tt * (1.0 + e) * u_n + k_nt * u_t) * by_det;
        const double p_t = (-k_nn * u_t + k_nt * (1.0 + e) * u_n) * by_det;
        const double px = p_n * nx - p_t * ny, py = p_n * ny + p_t * nx;
        answered.at[i] = (p_n > 0.0) & (u_n < 0.0) ? 1.0 : 0.0;
        const double size = std::sqrt(px * px + py * py);
        const double normal_work = -0.5 * p_n * u_n * (1.0 - e), tangential_work = -0.5 * p_t * u_t;
        outputs[0].at[i] = -(x + r_n) / w_n;
        outputs[1].at[i] = size * by_m1;
        outputs[2].at[i] = size * by_m2;
        directions[0][0].at[i] = py * c1 - px * s1;
        directions[0][1].at[i] = -(px * c1 + py * s1);
        directions[1][0].at[i] = -(py * c2 - px * s2);
        directions[1][1].at[i] = px * c2 + py * s2;
        outputs[5].at[i] = x;
        outputs[6].at[i] = normal_work + tangential_work;
        outputs[7].at[i] = normal_work;
        outputs[8].at[i] = tangential_work;
    }
    for (int vehicle = 0; vehicle < 2; vehicle++) {
        const auto &[across, along] = directions[vehicle];
        EACH outputs[3 + vehicle].at[i] = std::atan2(across.at[i], along.at[i]);
    }
}

// Puts the samples that have an answer, of the first `count`, to the front, and tells how many there are.
size_t pack(std::array<Column, OUTPUTS> &outputs, const Column &answered, size_t count) {
    if (std::all_of(answered.at, answered.at + count, [](double is) { return is == 1.0; })) return count;
    size_t good = 0;
    for (size_t i = 0; i < count; i++) {
        for (Column &output : outputs) output.at[good] = output.at[i];
        good += answered.at[i] == 1.0;
    }
    return good;
}

// Of the ordered values between two places, of which no other value lies between these: the one at a share of all, by Hyndman and Fan's type 7.
double quantile(std::vector<double> &values, double share, size_t low, size_t high) {
    const double position = share * static_cast<double>(values.size() - 1);
    const auto place = static_cast<size_t>(position);
    const auto at = values.begin() + static_cast<ptrdiff_t>(place);
    const auto end = values.begin() + static_cast<ptrdiff_t>(high);
    std::nth_element(values.begin() + static_cast<ptrdiff_t>(low), at, end);
    const double next = at + 1 == end ? *at : *std::min_element(at + 1, end);
    return *at + (next - *at) * (position - static_cast<double>(place));
}

void summarise(const char *name, std::vector<double> &values) {
    const auto count = static_cast<double>(values.size());
    double sum = 0.0, squares = 0.0;
    _Pragma("omp simd reduction(+ : sum)") for (size_t i = 0; i < values.size(); i++) sum += values[i];
    const double mean = sum / count;
    _Pragma("omp simd reduction(+ : squares)") for (size_t i = 0; i < values.size(); i++) squares += (values[i] - mean) * (values[i] - mean);
    // The median first: beyond it there are half as many values for the other two.
    const size_t middle = (values.size() - 1) / 2 + 1;
    const double median = quantile(values, 0.5, 0, values.size());
    const double low = quantile(values, 0.025, 0, middle), high = quantile(values, 0.975, middle, values.size());
    std::printf("%-24s %.6g %.6g %.6g %.6g %.6g\n", name, mean, std::sqrt(squares / (count - 1.0)), low, median, high);
}

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace

int main(int arguments, char **argument) {
    const size_t samples = arguments > 1 ? std::strtoull(argument[1], nullptr, 10) : 1'000'000;
    if (samples < 1000) {
        std::fputs("at least 1000 samples\n", stderr);
        return 2;
    }
    const double started = seconds();
    std::array<std::vector<double>, OUTPUTS> columns;
    for (auto &column : columns) column.resize(samples);
    Draws draws;
    std::array<Column, OUTPUTS> outputs;
    Column answered;
    size_t succeeded = 0;
    for (size_t first = 0; first < samples; first += BLOCK) {
        draws.begin(first);
        solve(draws, outputs, answered);
        const size_t count = std::min<size_t>(BLOCK, samples - first);
        const size_t good = pack(outputs, answered, count);
        for (int output = 0; output < OUTPUTS; output++)
            std::copy_n(outputs[output].at, good, columns[output].begin() + static_cast<ptrdiff_t>(succeeded));
        succeeded += good;
    }
    for (auto &column : columns) column.resize(succeeded);
    const double sampled = seconds();
    for (int output = 0; output < OUTPUTS; output++) summarise(NAMES[output], columns[output]);
    const double by_sample = 1e9 / static_cast<double>(samples);
    std::fprintf(stderr, "%.1f ns a sample, %.1f of it for the statistics\n", (seconds() - started) * by_sample, (seconds() - sampled) * by_sample);
}
