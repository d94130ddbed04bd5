/* The crane loop by hand: the yardstick of `make bench`.

   The same plant (plants/crane.py), controller (scenarios/crane) and algorithm
   as fcl_sim: Dormand-Prince 5(4) with step control between writes, friction as
   modes, events looked for within each step and located by the method of
   Illinois on steps of the scheme, and the same samples recorded. Everything is known to the compiler: five states,
   25 rules, three blocks. */
#include <math.h>
#include <string.h>

enum { N = 5, STUCK = 0, FORWARD = 1, BACKWARD = 2, RULES = 25 };

typedef struct {
    double M, m, L, g, vmax, vb, lag, cr, bv, zeta, adhesion, limiter;
} crane;

static const double A[6][6] = {
    { 1.0 / 5 },
    { 3.0 / 40, 9.0 / 40 },
    { 44.0 / 45, -56.0 / 15, 32.0 / 9 },
    { 19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729 },
    { 9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656 },
    { 35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84 },
};
static const double E[7] = { 71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40 };
static const double SCALE[N] = { 1, 1, 0.1, 0.1, 1000 };

static inline double least(double a, double b) { return a < b ? a : b; }
static inline double most(double a, double b) { return a > b ? a : b; }

static inline double hold(const crane *p) { return p->cr * (p->M + p->m) * p->g; }

static inline double pull(const double *x, const crane *p)
{
    double s = sin(x[2]), c = cos(x[2]), w = x[3], d = 2 * p->zeta * sqrt(p->g * p->L) * w;
    return x[4] + p->m * p->L * w * w * s + p->m * c * (p->g * s + d);
}

static inline double commanded(double power, double v, const crane *p)
{
    double f = 1000 * power / most(fabs(v), p->vb), grip = p->adhesion * (p->M + p->m) * p->g;
    if (f > 0) f = least(f, most(0, p->limiter * (p->vmax - v)));
    else f = most(f, least(0, -p->limiter * (p->vmax + v)));
    return least(most(f, -grip), grip);
}

static inline void dynamics(const double *restrict x, double power, const crane *restrict p, int mode, double *restrict dx)
{
    double v = x[1], w = x[3], s = sin(x[2]), c = cos(x[2]);
    double swing = p->g * s + 2 * p->zeta * sqrt(p->g * p->L) * w, a = 0;
    if (mode != STUCK) {
        double friction = p->bv * v + (mode == FORWARD ? hold(p) : -hold(p));
        a = (x[4] - friction + p->m * (p->L * w * w * s + c * swing)) / (p->M + p->m - p->m * c * c);
    }
    dx[0] = v;
    dx[1] = a;
    dx[2] = w;
    dx[3] = -(a * c + swing) / p->L;
    dx[4] = (commanded(power, v, p) - x[4]) / p->lag;
}

/* The event that the mode waits for: beyond zero when positive. */
static inline void events(const double *x, const crane *p, int mode, double *g)
{
    g[0] = mode == FORWARD ? -x[1] : -1;
    g[1] = mode == BACKWARD ? x[1] : -1;
    g[2] = g[3] = -1;
    if (mode == STUCK) {
        double now = pull(x, p);
        g[2] = now - hold(p);
        g[3] = -now - hold(p);
    }
}

static int transition(int event, double *x, const crane *p)
{
    if (event == 2) return FORWARD;
    if (event == 3) return BACKWARD;
    if (event >= 0) x[1] = 0;
    if (x[1] != 0) return x[1] > 0 ? FORWARD : BACKWARD;
    double now = pull(x, p);
    return fabs(now) <= hold(p) ? STUCK : now > 0 ? FORWARD : BACKWARD;
}

static inline void attempt(double h, const double *restrict x, double u, const crane *restrict p, int mode,
                           double k[7][N], double *restrict y)
{
    for (int s = 1; s <= 6; s++) {
        for (int i = 0; i < N; i++) {
            double sum = 0;
            for (int j = 0; j < s - 1; j++) sum += A[s - 1][j] * k[j][i];
            y[i] = x[i] + h * sum + h * A[s - 1][s - 1] * k[s - 1][i];
        }
        dynamics(y, u, p, mode, k[s]);
    }
}

static inline int beyond(const double *g, const int *armed)
{
    for (int i = 0; i < 4; i++) if (armed[i] && g[i] > 0) return i;
    return -1;
}
static inline void rearm(const double *g, int *armed)
{
    for (int i = 0; i < 4; i++) if (g[i] <= 0) armed[i] = 1;
}

static int settle(int event, double *x, const crane *p, int mode, double *g, int *armed)
{
    for (int n = 0; event >= 0 && n < 1000; n++) {
        mode = transition(event, x, p);
        armed[event] = 0;
        events(x, p, mode, g);
        rearm(g, armed);
        event = beyond(g, armed);
    }
    return mode;
}

static double locate(int *event, double h, const double *x, double u, const crane *p, int mode, double k[7][N],
                     double *y, const double *g0, double *g1, const int *armed)
{
    double lo = 0, hi = 1, glo = g0[*event], ghi = g1[*event], reached = 1;
    int side = 0;
    while (hi - lo > 1e-13) {
        double part = (lo * ghi - hi * glo) / (ghi - glo);
        if (!(lo < part && part < hi)) part = 0.5 * (lo + hi);
        attempt(part * h, x, u, p, mode, k, y);
        events(y, p, mode, g1);
        reached = part;
        int earlier = beyond(g1, armed);
        if (earlier >= 0 && earlier != *event) { *event = earlier; lo = 0; hi = part; side = 0; glo = g0[earlier]; ghi = g1[earlier]; }
        else if (earlier == *event) { hi = part; ghi = g1[*event]; if (side == 1) glo *= 0.5; side = 1; }
        else { lo = part; glo = g1[*event]; if (side == -1) ghi *= 0.5; side = -1; }
    }
    if (reached != hi) { attempt(hi * h, x, u, p, mode, k, y); events(y, p, mode, g1); }
    return hi;
}

/* At what part of a step an event may stand beyond zero that does not at its end, 1 if at none: in the middle, on the
   cubic through both ends, or where the parabola through its beginning, middle and end is highest. */
static inline double within(double h, const double *x, const crane *p, int mode, double k[7][N], const double *y,
                            const double *g0, const double *g1, const int *armed)
{
    double middle[N], g[4], first = 1;
    for (int i = 0; i < N; i++) middle[i] = 0.5 * (x[i] + y[i]) + 0.125 * h * (k[0][i] - k[6][i]);
    events(middle, p, mode, g);
    for (int i = 0; i < 4; i++) {
        if (!armed[i] || g0[i] > 0 || g1[i] > 0) continue;
        if (g[i] > 0) { first = least(first, 0.5); continue; }
        double slope = 4 * g[i] - 3 * g0[i] - g1[i], bend = 2 * (g0[i] + g1[i]) - 4 * g[i];
        if (slope > 0 && slope + 2 * bend < 0 && g0[i] - slope * slope / (4 * bend) > 0)
            first = least(first, slope / (-2 * bend));
    }
    return first;
}

static int advance(double length, double *x, double u, const crane *p, int mode, double rtol, double *guess, int *armed)
{
    double k[7][N], y[N], g0[4], g1[4], done = 0;
    events(x, p, mode, g0);
    rearm(g0, armed);
    mode = settle(beyond(g0, armed), x, p, mode, g0, armed);
    dynamics(x, u, p, mode, k[0]);
    while (done < length) {
        double wanted = *guess, pieces = most(1, ceil((length - done) / wanted - 1e-9)), h = (length - done) / pieces;
        attempt(h, x, u, p, mode, k, y);
        double error = 0;
        for (int i = 0; i < N; i++) {
            double sum = 0;
            for (int j = 0; j < 7; j++) sum += E[j] * k[j][i];
            error = most(error, fabs(h * sum) / (rtol * (SCALE[i] + most(fabs(x[i]), fabs(y[i])))));
        }
        if (error > 1) { *guess = h * most(0.2, 0.9 * pow(error, -0.2)); continue; }
        double growth = error < 1.889568e-4 ? 5 : 0.9 * pow(error, -0.2), part = 1;
        *guess = growth < 5 ? h * growth : most(wanted, 5 * h);
        events(y, p, mode, g1);
        int event = beyond(g1, armed);
        double seen = within(h, x, p, mode, k, y, g0, g1, armed);
        if (seen < 1) {
            attempt(seen * h, x, u, p, mode, k, y);
            events(y, p, mode, g1);
            int earlier = beyond(g1, armed);
            if (earlier >= 0) { event = earlier; part = seen; }
            else { attempt(h, x, u, p, mode, k, y); events(y, p, mode, g1); }
        }
        if (event >= 0) part *= locate(&event, part * h, x, u, p, mode, k, y, g0, g1, armed);
        done = pieces == 1 && part == 1 ? length : done + part * h;
        memcpy(x, y, sizeof y);
        memcpy(g0, g1, sizeof g1);
        rearm(g0, armed);
        if (event >= 0) { mode = settle(event, x, p, mode, g0, armed); dynamics(x, u, p, mode, k[0]); }
        else memcpy(k[0], k[6], sizeof k[0]);
    }
    return mode;
}

static inline double tri(double x, double a, double c, double b)
{
    return most(0, least((x - a) * (1.0 / (c - a)), (b - x) * (1.0 / (b - c))));
}

/* The completed rule base: 5 x 5 terms, five singletons, MIN, MAX, CoGS; degrees of the rules recorded. */
static double rules(double d, double a, double *restrict degree)
{
    static const unsigned char THEN[5][5] = {
        { 0, 0, 0, 0, 0 }, { 1, 1, 2, 3, 3 }, { 1, 1, 4, 3, 3 }, { 0, 1, 4, 4, 4 }, { 3, 4, 3, 4, 4 },
    };
    static const double POWER[5] = { -27, -9, 0, 9, 27 };
    double D[5] = { least(1, most(0, -d * 0.2)), tri(d, -5, 0, 5), tri(d, 0, 5, 10), tri(d, 5, 10, 22),
                    least(1, most(0, (d - 10) * (1.0 / 12))) };
    double G[5] = { least(1, most(0, (-a - 5) * (1.0 / 45))), tri(a, -50, -5, 0), tri(a, -5, 0, 5), tri(a, 0, 5, 50),
                    least(1, most(0, (a - 5) * (1.0 / 45))) };
    double best[5] = { 0 }, s = 0, t = 0;
    for (int i = 0; i < 5; i++)
        for (int j = 0; j < 5; j++) {
            double mu = least(D[i], G[j]);
            degree[5 * i + j] = mu;
            best[THEN[i][j]] = most(best[THEN[i][j]], mu);
        }
    for (int i = 0; i < 5; i++) { s += best[i]; t += best[i] * POWER[i]; }
    return s > 0 ? t / s : 0;
}

/* What stands between the plant and the controller: noise drawn beforehand, quantisation, latency. */
typedef struct {
    const double *distance_noise, *angle_noise;
    double distance_step, angle_step, latency;
} disturbance;

/* x: position, speed, angle, rate, drive force. record: scans + 1 rows of 10 signals, of noise, sum and step for both
   sensors where they are disturbed, then 2 inputs, output, flag, degrees. */
static inline void loop(const crane *p, double *x, long scans, double scan, double rtol, double *record, const disturbance *by)
{
    const int signals = by ? 9 + 6 : 9, columns = signals + 4 + RULES;
    double speed = 0, before = 0, guess = scan, filter = 0.05, held = 0;
    int armed[4] = { 0 }, mode = transition(-1, x, p);
    for (long n = 0; n <= scans; n++) {
        double *row = record + n * columns, distance = 0 - x[0], angle = x[2] * (180 / M_PI);
        row[0] = distance;
        row[1] = angle;
        if (by) {
            row[9] = by->distance_noise[n];
            row[10] = by->angle_noise[n];
            row[11] = distance + row[9];
            row[12] = angle + row[10];
            row[13] = distance = by->distance_step * floor(row[11] / by->distance_step + 0.5);
            row[14] = angle = by->angle_step * floor(row[12] / by->angle_step + 0.5);
        }
        if (n) speed += scan / (filter + scan) * ((-distance - before) / scan - speed);
        before = -distance;
        double predicted = distance - 6 * speed;
        double power = rules(predicted, angle, row + signals + 4);
        row[2] = 180 / M_PI * sqrt(x[2] * x[2] + x[3] * x[3] * p->L / p->g);
        row[3] = x[0];
        row[4] = x[1];
        row[5] = x[4] / 1000;
        row[6] = by ? held : power;
        row[7] = speed;
        row[8] = predicted;
        row[signals] = predicted;
        row[signals + 1] = angle;
        row[signals + 2] = power;
        row[signals + 3] = 1;
        if (n < scans && by) mode = advance(by->latency, x, held, p, mode, rtol, &guess, armed);
        held = power;
        if (n < scans) mode = advance(by ? scan - by->latency : scan, x, held, p, mode, rtol, &guess, armed);
    }
}

void crane_loop(const crane *p, double *x, long scans, double scan, double rtol, double *record)
{
    loop(p, x, scans, scan, rtol, record, 0);
}

void crane_loop_disturbed(const crane *p, double *x, long scans, double scan, double rtol, double *record, const disturbance *by)
{
    loop(p, x, scans, scan, rtol, record, by);
}
