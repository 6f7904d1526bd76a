/* Propagation and update of a filter with 9 states and 3 measurements, as one writes them who is in no hurry: each
   covariance is computed once, in its lower half, and mirrored. */
#define N 9
#define P 3

void propagate(const double F[N][N], const double C[N][N], const double Q[N][N], double out[N][N])
{
    double product[N][N];
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
            out[i][j] = sum;
            out[j][i] = sum;
        }
    }
}

void repeat(const double F[N][N], const double C[N][N], const double Q[N][N], double out[N][N], int times)
{
    for (int i = 0; i < times; i++) {
        propagate(F, C, Q, out);
        __asm__ volatile("" ::: "memory");
    }
}
