/* Fuzzy blocks by hand: the yardstick of `make bench`.

   The container crane of Annex C with singletons (CoGS) and with triangles
   (MIN, MAX, exact CoG within -36 .. 36), and a table of 49 rules. Everything
   is known to the compiler. The chains feed each result into the next inputs,
   as a loop does, so that calls cannot overlap. */
#include <math.h>
#include <stddef.h>

static inline double least(double a, double b) { return a < b ? a : b; }
static inline double most(double a, double b) { return a > b ? a : b; }
static inline double ramp(double x, double from, double rate) { return most(0, least(1, (x - from) * rate)); }
static inline double triangle(double x, double a, double b, double c)
{
    return most(0, least((x - a) * (1 / (b - a)), (c - x) * (1 / (c - b))));
}

typedef struct { double negative, zero, positive, high; } degrees;

static inline degrees rules(double distance, double angle)
{
    double far = ramp(distance, 10, 1.0 / 12), medium = triangle(distance, 5, 10, 22);
    double close = triangle(distance, 0, 5, 10), here = triangle(distance, -5, 0, 5);
    double neg_big = ramp(-angle, 5, 1.0 / 45), neg_small = triangle(angle, -50, -5, 0);
    double upright = triangle(angle, -5, 0, 5), pos_small = triangle(angle, 0, 5, 50);
    return (degrees){
        .negative = least(medium, neg_small),
        .zero = least(here, upright),
        .positive = most(least(far, upright), most(least(far, neg_big), least(close, pos_small))),
        .high = least(far, neg_small),
    };
}

static inline double cogs(double distance, double angle)
{
    degrees d = rules(distance, angle);
    double sum = d.negative + d.zero + d.positive + d.high;
    return sum > 0 ? (9 * d.positive + 27 * d.high - 9 * d.negative) / sum : 0;
}

/* All places where the upper envelope of the clipped triangles can have a corner, sorted; between them
   it is straight. */
enum { HALF = 18, LIMIT = 36 };

static double cog(double distance, double angle)
{
    degrees d = rules(distance, angle);
    const double centres[4] = { -9, 0, 9, 27 }, all[4] = { d.negative, d.zero, d.positive, d.high };
    double centre[4], height[4], corners[48];
    int terms = 0, n = 0;
    for (int i = 0; i < 4; i++)
        if (all[i] > 0) { centre[terms] = centres[i]; height[terms++] = all[i]; }
    if (terms == 0) return 0;
    corners[n++] = -LIMIT;
    corners[n++] = LIMIT;
    for (int i = 0; i < terms; i++) {
        double c = centre[i], flat = HALF * (1 - height[i]);
        const double own[4] = { c - HALF, c - flat, c + flat, c + HALF };
        for (int k = 0; k < 4; k++) if (fabs(own[k]) < LIMIT) corners[n++] = own[k];
        for (int j = 0; j < i; j++) {
            const double met[3] = { 0.5 * (centre[j] + c), centre[j] + flat, c - HALF * (1 - height[j]) };
            for (int k = 0; k < 3; k++) if (fabs(met[k]) < LIMIT) corners[n++] = met[k];
        }
    }
    for (int i = 1; i < n; i++) {
        double x = corners[i];
        int j = i;
        for (; j > 0 && corners[j - 1] > x; j--) corners[j] = corners[j - 1];
        corners[j] = x;
    }
    double area = 0, moment = 0, left = 0, before = 0;
    for (int i = 0; i < n; i++) {
        double x = corners[i], degree = 0;
        for (int k = 0; k < terms; k++)
            degree = most(degree, least(height[k], 1 - fabs(x - centre[k]) * (1.0 / HALF)));
        if (i > 0) {
            double width = x - left;
            area += width * (before + degree);
            moment += width * (left * (2 * before + degree) + x * (before + 2 * degree));
        }
        left = x;
        before = degree;
    }
    return area > 0 ? moment / (3 * area) : 0;
}

/* Seven triangles on -3 .. 3 for each input, shoulders at the ends; every rule is evaluated. */
static inline void seven(double x, double *degree)
{
    x = most(-3, least(3, x));
    for (int i = 0; i < 7; i++) degree[i] = most(0, 1 - fabs(x - (i - 3)));
}

static inline double table(double a, double b)
{
    double of_a[7], of_b[7], out[7] = { 0 }, sum = 0, moment = 0;
    seven(a, of_a);
    seven(b, of_b);
    for (int i = 0; i < 7; i++)
        for (int j = 0; j < 7; j++) {
            int k = i + j < 3 ? 0 : i + j > 9 ? 6 : i + j - 3;
            out[k] = most(out[k], least(of_a[i], of_b[j]));
        }
    for (int k = 0; k < 7; k++) { sum += out[k]; moment += out[k] * (k - 3); }
    return sum > 0 ? moment / sum : 0;
}

#define BLOCK(name)                                                                                      \
    double name##_one(double a, double b) { return name(a, b); }                                         \
    void name##_batch(const double *restrict a, const double *restrict b, double *restrict y, size_t n)  \
    {                                                                                                    \
        for (size_t i = 0; i < n; i++) y[i] = name(a[i], b[i]);                                          \
    }                                                                                                    \
    double name##_chain(const double *a, const double *b, size_t n)                                      \
    {                                                                                                    \
        double y = 0;                                                                                    \
        for (size_t i = 0; i < n; i++) y = name(a[i] + 1e-12 * y, b[i] - 1e-12 * y);                     \
        return y;                                                                                        \
    }

BLOCK(cogs)
BLOCK(cog)
BLOCK(table)

/* The crane's block on a second-order lag, one step of Runge-Kutta a scan; p: gain, damping, inertia, target. */
static inline void lag(const double *x, double u, const double *p, double *dx)
{
    dx[0] = x[1];
    dx[1] = (p[0] * u - x[0] - p[1] * x[1]) / p[2];
}

enum { RULES = 6, COLUMNS = 3 + 4 + RULES };

/* The block on what it reads; row: 3 signals, 2 inputs, output, flag, the degrees of the 6 rules. */
static inline double controlled(double distance, double angle, double *restrict row)
{
    double far = ramp(distance, 10, 1.0 / 12);
    double small = triangle(angle, -50, -5, 0), upright = triangle(angle, -5, 0, 5);
    double fired[RULES] = {
        least(far, upright), least(far, small), least(far, ramp(-angle, 5, 1.0 / 45)),
        least(triangle(distance, 5, 10, 22), small),
        least(triangle(distance, 0, 5, 10), triangle(angle, 0, 5, 50)),
        least(triangle(distance, -5, 0, 5), upright),
    };
    double positive = most(fired[0], most(fired[2], fired[4]));
    double sum = positive + fired[1] + fired[3] + fired[5];
    double u = sum > 0 ? (9 * positive + 27 * fired[1] - 9 * fired[3]) / sum : 0;
    row[0] = row[3] = distance;
    row[1] = row[4] = angle;
    row[2] = row[5] = u;
    row[6] = sum > 0;
    for (int i = 0; i < RULES; i++) row[7 + i] = fired[i];
    return u;
}

/* record: scans + 1 rows. */
void lag_loop(const double *p, double *x, long scans, double scan, double *record)
{
    double a[2], b[2], c[2], d[2], y[2];
    for (long n = 0; n <= scans; n++) {
        double u = controlled(p[3] - x[0], 30 * x[1], record + n * COLUMNS);
        if (n == scans) break;
        lag(x, u, p, a);
        for (int i = 0; i < 2; i++) y[i] = x[i] + 0.5 * scan * a[i];
        lag(y, u, p, b);
        for (int i = 0; i < 2; i++) y[i] = x[i] + 0.5 * scan * b[i];
        lag(y, u, p, c);
        for (int i = 0; i < 2; i++) y[i] = x[i] + scan * c[i];
        lag(y, u, p, d);
        for (int i = 0; i < 2; i++) x[i] += scan / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    }
}

/* A crane without a drive of its own, as plain_crane_plant.py; p: trolley, load, cable, gravity, friction, force of a kW. */
static inline void swing(const double *restrict x, double u, const double *restrict p, double *restrict dx)
{
    double s = sin(x[2]), c = cos(x[2]);
    double force = p[5] * u - p[4] * x[1] + p[1] * s * (p[2] * x[3] * x[3] + p[3] * c);
    dx[0] = x[1];
    dx[1] = force / (p[0] + p[1] * s * s);
    dx[2] = x[3];
    dx[3] = -(dx[1] * c + p[3] * s) / p[2];
}

/* Runge-Kutta with `steps` a scan; record: scans + 1 rows. */
void plain_crane_loop(const double *p, double *x, long scans, double scan, long steps, double *record)
{
    double a[4], b[4], c[4], d[4], y[4], h = scan / steps;
    for (long n = 0; n <= scans; n++) {
        double u = controlled(0 - x[0], x[2] * (180 / M_PI), record + n * COLUMNS);
        if (n == scans) break;
        for (long k = 0; k < steps; k++) {
            swing(x, u, p, a);
            for (int i = 0; i < 4; i++) y[i] = x[i] + 0.5 * h * a[i];
            swing(y, u, p, b);
            for (int i = 0; i < 4; i++) y[i] = x[i] + 0.5 * h * b[i];
            swing(y, u, p, c);
            for (int i = 0; i < 4; i++) y[i] = x[i] + h * c[i];
            swing(y, u, p, d);
            for (int i = 0; i < 4; i++) x[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
        }
    }
}
