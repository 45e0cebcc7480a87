/* tests/workshop/my.h -- What workshop/my.c consists of, in the end. The compiler reads
 * this before my.c, so another type of argument is an error there, with its line. */
#ifndef MY_H
#define MY_H

extern double m, c, cubic, rho, x0, p0, kappa, alpha;
extern int caputo, fast, second;

double grad(double x);
double hess(double x);
double solve(double A, double h, double x, double r);
void integrate(double h, int N, double *x, double *p);
double exact(double t);
void weights(double order, int count, double *w);
void delta(double order, double h, int N, const double *z, double *out);

#endif
