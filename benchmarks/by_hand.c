/* A Kalman filter with 9 states, 3 inputs and 3 measurements, as one writes it by hand: lengths are numbers, what is
   symmetric is computed in its lower half and mirrored, and `restrict` says that arrays do not overlap. */
#include <math.h>

#define N 9
#define M 3
#define P 3

void propagate(double F[restrict N][N], double B[restrict N][M], double Q[restrict N][N], double x[restrict N],
    double C[restrict N][N], double u[restrict M], double x_next[restrict N], double C_next[restrict N][N])
{
    double product[N][N];
    for (int i = 0; i < N; i++) {
        double sum = 0.0;
        for (int k = 0; k < N; k++) {
            sum += F[i][k] * x[k];
        }
        for (int k = 0; k < M; k++) {
            sum += B[i][k] * u[k];
        }
        x_next[i] = sum;
    }
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) {
            product[i][j] = 0.0;
        }
        for (int k = 0; k < N; k++) {
            for (int j = 0; j < N; j++) {
                product[i][j] += F[i][k] * C[k][j];
            }
        }
    }
    for (int i = 0; i < N; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = Q[i][j];
            for (int k = 0; k < N; k++) {
                sum += product[i][k] * F[j][k];
            }
            C_next[i][j] = sum;
            C_next[j][i] = sum;
        }
    }
}

void update(double H[restrict P][N], double R[restrict P][P], double y[restrict P], double x[restrict N],
    double C[restrict N][N], double x_next[restrict N], double C_next[restrict N][N])
{
    double HC[P][N], S[P][P], G[P][N], z[P];
    for (int i = 0; i < P; i++) {
        for (int j = 0; j < N; j++) {
            HC[i][j] = 0.0;
        }
        for (int k = 0; k < N; k++) {
            for (int j = 0; j < N; j++) {
                HC[i][j] += H[i][k] * C[k][j];
            }
        }
    }
    for (int i = 0; i < P; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = R[i][j];
            for (int k = 0; k < N; k++) {
                sum += HC[i][k] * H[j][k];
            }
            for (int k = 0; k < j; k++) {
                sum -= S[i][k] * S[j][k];
            }
            S[i][j] = i == j ? sqrt(sum) : sum / S[j][j];
        }
    }
    for (int i = 0; i < P; i++) {
        const double scale = 1.0 / S[i][i];
        for (int j = 0; j < N; j++) {
            double sum = HC[i][j];
            for (int k = 0; k < i; k++) {
                sum -= S[i][k] * G[k][j];
            }
            G[i][j] = sum * scale;
        }
    }
    for (int i = P - 1; i >= 0; i--) {
        const double scale = 1.0 / S[i][i];
        for (int j = 0; j < N; j++) {
            double sum = G[i][j];
            for (int k = i + 1; k < P; k++) {
                sum -= S[k][i] * G[k][j];
            }
            G[i][j] = sum * scale;
        }
    }
    for (int i = 0; i < P; i++) {
        z[i] = y[i];
        for (int k = 0; k < N; k++) {
            z[i] -= H[i][k] * x[k];
        }
    }
    for (int i = 0; i < N; i++) {
        double sum = x[i];
        for (int k = 0; k < P; k++) {
            sum += G[k][i] * z[k];
        }
        x_next[i] = sum;
        for (int j = 0; j <= i; j++) {
            C_next[i][j] = C[i][j] - (G[0][i] * HC[0][j] + G[1][i] * HC[1][j] + G[2][i] * HC[2][j]);
        }
    }
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < i; j++) {
            C_next[j][i] = C_next[i][j];
        }
    }
}

void propagate_often(double F[N][N], double B[N][M], double Q[N][N], double x[N], double C[N][N], double u[M],
    double x_next[N], double C_next[N][N], int times)
{
    for (int i = 0; i < times; i++) {
        propagate(F, B, Q, x, C, u, x_next, C_next);
        __asm__ volatile("" ::: "memory");
    }
}

void update_often(double H[P][N], double R[P][P], double y[P], double x[N], double C[N][N], double x_next[N],
    double C_next[N][N], int times)
{
    for (int i = 0; i < times; i++) {
        update(H, R, y, x, C, x_next, C_next);
        __asm__ volatile("" ::: "memory");
    }
}
