/* The loop that a competent engineer writes: RK4 with one step per sample, libm, landings by Newton's method on the
 * length of the step; rest is skipped while the uplift threshold is not passed.
 *
 * Reads: dt g samples blocks, then the samples [m/s2], then height and thickness of each block [m]. Writes the seconds
 * that it took, the share of the block-steps in which a block moved, and a line with the peak rotation and the number of
 * impacts for each block (pi/2: overturned). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

typedef struct { double p2, alpha, sin_a, cos_a, tan_a, r; } Block;

static inline double accel(const Block *b, double s, double y, double u) {
    double phi = b->alpha - y;
    return -b->p2 * (sin(phi) + s * u * cos(phi));
}

/* y = |theta| about the edge s. */
static inline void rk4(const Block *b, double s, double *y, double *w, double u0, double u1, double h) {
    double um = 0.5 * (u0 + u1), half = 0.5 * h;
    double k1 = accel(b, s, *y, u0);
    double w2 = *w + half * k1, k2 = accel(b, s, *y + half * *w, um);
    double w3 = *w + half * k2, k3 = accel(b, s, *y + half * w2, um);
    double w4 = *w + h * k3, k4 = accel(b, s, *y + h * w3, u1);
    *y += h / 6 * (*w + 2 * w2 + 2 * w3 + w4);
    *w += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

static double peak(const Block *b, const double *u, int n, double dt, long *moved, int *impacts) {
    double y = 0, w = 0, s = 1, best = 0;
    *impacts = 0;
    int moving = 0;
    for (int k = 0; k + 1 < n; k++) {
        double t = 0; /* part of the step that is over */
        double du = u[k + 1] - u[k];
        if (!moving) {
            double a0 = fabs(u[k]), a1 = fabs(u[k + 1]);
            if (a0 > b->tan_a) t = 0, s = u[k] < 0 ? 1 : -1;
            else if (a1 > b->tan_a) {
                s = u[k + 1] < 0 ? 1 : -1;
                t = (-s * b->tan_a - u[k]) / du;
            } else continue;
            moving = 1, y = w = 0;
        }
        ++*moved;
        for (int i = 0; moving && t < 1 && i < 50; i++) {
            double y0 = y, w0 = w, u0 = u[k] + t * du;
            rk4(b, s, &y, &w, u0, u[k + 1], (1 - t) * dt);
            if (y >= M_PI_2) return M_PI_2;
            if (y > best) best = y;
            if (w0 > 0 && w < 0) { /* the peak inside the step, by the cubic's tangent parabola */
                double x = w0 / (w0 - w), h = (1 - t) * dt, ym = y0, wm = w0;
                rk4(b, s, &ym, &wm, u0, u0 + x * (u[k + 1] - u0), x * h);
                ym += 0.5 * wm * wm / fabs(accel(b, s, ym, u0 + x * (u[k + 1] - u0)));
                if (ym > best) best = ym;
            }
            if (y > 0 || (y == 0 && w >= 0)) { t = 1; break; }
            /* An impact: Newton on the length of the step. */
            double lo = 0, hi = 1, x = y0 > 0 ? y0 / (y0 - y) : 0.5;
            for (int j = 0; j < 40; j++) {
                y = y0, w = w0;
                double e = x * (1 - t) * dt;
                rk4(b, s, &y, &w, u0, u0 + x * (u[k + 1] - u0), e);
                if (y > 0) lo = x; else hi = x;
                double next = x - y / (w * (1 - t) * dt);
                if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
                if (fabs(next - x) < 1e-14) break;
                x = next;
            }
            t += x * (1 - t);
            ++*impacts;
            double speed = -w * b->r, un = u[k] + t * du;
            y = 0, s = -s, w = speed;
            if (speed < 1e-6) {
                if (fabs(un) > b->tan_a) s = un < 0 ? 1 : -1, w = 0;
                else moving = 0;
            }
        }
        if (moving && t < 1) moving = 0;
    }
    return best;
}

int main(int argc, char **argv) {
    double dt, g;
    int n, blocks;
    FILE *in = argc > 1 ? fopen(argv[1], "r") : stdin;
    if (!in || fscanf(in, "%lf %lf %d %d", &dt, &g, &n, &blocks) != 4) return 2;
    double *u = malloc(n * sizeof *u), *peaks = malloc(blocks * sizeof *peaks);
    Block *b = malloc(blocks * sizeof *b);
    for (int i = 0; i < n; i++) {
        if (fscanf(in, "%lf", u + i) != 1) return 2;
        u[i] /= g;
    }
    for (int i = 0; i < blocks; i++) {
        double height, thickness;
        if (fscanf(in, "%lf %lf", &height, &thickness) != 2) return 2;
        double R = 0.5 * hypot(height, thickness), alpha = atan2(thickness, height), sn = sin(alpha);
        b[i] = (Block){ 0.75 * g / R, alpha, sn, cos(alpha), thickness / height, fmax(1 - 1.5 * sn * sn, 0) };
    }
    int *impacts = malloc(blocks * sizeof *impacts);
    long moved = 0;
    struct timespec t0, t1;
    clock_gettime(CLOCK_MONOTONIC, &t0);
    for (int i = 0; i < blocks; i++) peaks[i] = peak(b + i, u, n, dt, &moved, impacts + i);
    clock_gettime(CLOCK_MONOTONIC, &t1);
    printf("%.9f %.6f\n", t1.tv_sec - t0.tv_sec + 1e-9 * (t1.tv_nsec - t0.tv_nsec), moved / ((double)blocks * (n - 1)));
    for (int i = 0; i < blocks; i++) printf("%.17g %d\n", peaks[i], impacts[i]);
}
