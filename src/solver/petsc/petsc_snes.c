/* Variational inequality  x >= lower,  F(x) >= 0,  (x - lower) F(x) = 0,  solved by SNES of PETSc: Newton's method
 * on the unknowns off their bound (SNESVINEWTONRSLS). F'(x) is a shell matrix; PETSc cuts its active rows and columns
 * out by a virtual submatrix, those of the sparse near matrix, which is only factorised, by a copy.
 *
 * A library of its own, which the program loads when it is asked for PETSc: it needs nothing of the program. Knows
 * nothing of the contact: the equations come as functions with a context (solver/petsc_binding.f90). In C because
 * PETSc's Fortran interface passes contexts through implicit interfaces and compiler-specific module files; here
 * callbacks are ordinary functions, and PETSc may have been built with another Fortran compiler.
 *
 * All objects live for one solve. The option database is emptied at the start: neither PETSC_OPTIONS nor a
 * petscrc file changes a result. */

#define _POSIX_C_SOURCE 200809L
#include <petscsnes.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(sizeof(PetscScalar) == sizeof(double), "PETSc must be built with real numbers in double precision");

enum { status_converged = 0, status_not_finite = 4, status_over_budget = 6 }; /* as in core/status.f90 */

typedef struct {
   void *context;
   void (*evaluate)(void *context, const double *x, double *f);       /* f = F(x) */
   void (*linearise)(void *context, const double *x, double *matrix); /* about x; nonzeros of the near matrix */
   void (*multiply)(void *context, const double *x, double *y);       /* y = F'(x_0) x, x_0: last linearised */
   double (*step_length)(void *context, const double *change);        /* longest step along -change from x_0 */
   int (*judge)(void *context, const double *x);                      /* status; any but those above: go on */
} equations_t;

typedef struct {
   int backtracks;             /* 1: line search on the norm of F; 0: none */
   int fill_levels;            /* of the incomplete factors */
   int largest_steps;          /* Newton steps */
   int restart;                /* GMRES steps before a restart */
   int largest_krylov;         /* GMRES steps of one Newton step */
   double linear_tolerance;    /* of GMRES, relative to the right side */
} settings_t;

typedef struct {
   int reason;                 /* SNESConvergedReason, 0 after an error */
   int steps, linear_steps;
} outcome_t;

static int owns_mpi = 0, owns_petsc = 0; /* what start_petsc started and finish_petsc has to end */

static PetscErrorCode evaluate(SNES snes, Vec x, Vec f, void *given)
{
   const equations_t *eq = given;
   const double *from;
   double *to;

   PetscFunctionBegin;
   (void)snes;
   PetscCall(VecGetArrayRead(x, &from));
   PetscCall(VecGetArrayWrite(f, &to));
   eq->evaluate(eq->context, from, to);
   PetscCall(VecRestoreArrayWrite(f, &to));
   PetscCall(VecRestoreArrayRead(x, &from));
   PetscFunctionReturn(0);
}

static PetscErrorCode linearise(SNES snes, Vec x, Mat product, Mat near, void *given)
{
   const equations_t *eq = given;
   const double *from;
   double *values;

   PetscFunctionBegin;
   (void)snes;
   PetscCall(VecGetArrayRead(x, &from));
   PetscCall(MatSeqAIJGetArrayWrite(near, &values));
   eq->linearise(eq->context, from, values);
   PetscCall(MatSeqAIJRestoreArrayWrite(near, &values));
   PetscCall(VecRestoreArrayRead(x, &from));
   PetscCall(MatAssemblyBegin(near, MAT_FINAL_ASSEMBLY));
   PetscCall(MatAssemblyEnd(near, MAT_FINAL_ASSEMBLY));
   PetscCall(MatAssemblyBegin(product, MAT_FINAL_ASSEMBLY));
   PetscCall(MatAssemblyEnd(product, MAT_FINAL_ASSEMBLY));
   PetscFunctionReturn(0);
}

static PetscErrorCode multiply(Mat product, Vec x, Vec y)
{
   equations_t *eq;
   const double *from;
   double *to;

   PetscFunctionBegin;
   PetscCall(MatShellGetContext(product, &eq));
   PetscCall(VecGetArrayRead(x, &from));
   PetscCall(VecGetArrayWrite(y, &to));
   eq->multiply(eq->context, from, to);
   PetscCall(VecRestoreArrayWrite(y, &to));
   PetscCall(VecRestoreArrayRead(x, &from));
   PetscFunctionReturn(0);
}

/* Shorten the step so that every point of the line search is in the domain of F. A step of no use becomes zero,
 * which the line search reports as a failure. */
static PetscErrorCode shorten(SNESLineSearch search, Vec x, Vec step, PetscBool *is_changed, void *given)
{
   const equations_t *eq = given;
   const double *change;
   double length;

   PetscFunctionBegin;
   (void)search;
   (void)x;
   PetscCall(VecGetArrayRead(step, &change));
   length = eq->step_length(eq->context, change);
   PetscCall(VecRestoreArrayRead(step, &change));
   *is_changed = length < 1 ? PETSC_TRUE : PETSC_FALSE;
   if (!(length > 0)) PetscCall(VecSet(step, 0));
   else if (length < 1) PetscCall(VecScale(step, length));
   PetscFunctionReturn(0);
}

/* The caller's criterion in place of PETSc's, which tests the norm of F only. */
static PetscErrorCode judge(SNES snes, PetscInt steps, PetscReal x_norm, PetscReal step_norm, PetscReal f_norm,
                            SNESConvergedReason *reason, void *given)
{
   const equations_t *eq = given;
   const double *at;
   Vec x;
   int status;

   PetscFunctionBegin;
   (void)steps, (void)x_norm, (void)step_norm;
   PetscCall(SNESGetSolution(snes, &x));
   PetscCall(VecGetArrayRead(x, &at));
   status = eq->judge(eq->context, at);
   PetscCall(VecRestoreArrayRead(x, &at));
   *reason = SNES_CONVERGED_ITERATING;
   if (status == status_converged) *reason = SNES_CONVERGED_FNORM_ABS;
   if (status == status_over_budget) *reason = SNES_DIVERGED_MAX_IT;
   if (status == status_not_finite || PetscIsInfOrNanReal(f_norm)) *reason = SNES_DIVERGED_FNORM_NAN;
   PetscFunctionReturn(0);
}

/* Sparse matrix with a pattern given by rows. */
static PetscErrorCode make_near(PetscInt n, const int *row_start, const int *column, Mat *near)
{
   PetscInt *starts, *columns, i;

   PetscFunctionBegin;
   PetscCall(PetscMalloc2(n + 1, &starts, row_start[n], &columns));
   for (i = 0; i <= n; i++) starts[i] = row_start[i];
   for (i = 0; i < row_start[n]; i++) columns[i] = column[i];
   PetscCall(MatCreate(PETSC_COMM_SELF, near));
   PetscCall(MatSetSizes(*near, n, n, n, n));
   PetscCall(MatSetType(*near, MATSEQAIJ));
   PetscCall(MatSeqAIJSetPreallocationCSR(*near, starts, columns, NULL));
   PetscCall(PetscFree2(starts, columns));
   PetscFunctionReturn(0);
}

static PetscErrorCode configure(SNES snes, equations_t *eq, const settings_t *settings)
{
   SNESLineSearch search;
   KSP ksp;
   PC pc;

   PetscFunctionBegin;
   PetscCall(SNESSetType(snes, SNESVINEWTONRSLS));
   PetscCall(SNESSetTolerances(snes, 0, 0, 0, settings->largest_steps, 1000000));
   PetscCall(SNESSetConvergenceTest(snes, judge, eq, NULL));
   PetscCall(SNESSetMaxLinearSolveFailures(snes, 1000000)); /* a step cut short by the cap is still a step */
   PetscCall(SNESGetLineSearch(snes, &search));
   PetscCall(SNESLineSearchSetType(search, settings->backtracks ? SNESLINESEARCHBT : SNESLINESEARCHBASIC));
   PetscCall(SNESLineSearchSetPreCheck(search, shorten, eq));

   PetscCall(SNESGetKSP(snes, &ksp));
   PetscCall(KSPSetType(ksp, KSPGMRES));
   PetscCall(KSPSetPCSide(ksp, PC_RIGHT));
   PetscCall(KSPGMRESSetRestart(ksp, settings->restart));
   PetscCall(KSPGMRESSetOrthogonalization(ksp, KSPGMRESModifiedGramSchmidtOrthogonalization));
   PetscCall(KSPSetTolerances(ksp, settings->linear_tolerance, 1e-300, 1e10, settings->largest_krylov));
   PetscCall(KSPGetPC(ksp, &pc));
   PetscCall(PCSetType(pc, PCILU));
   PetscCall(PCFactorSetMatOrderingType(pc, MATORDERINGNATURAL)); /* flow order, the load row last */
   PetscCall(PCFactorSetLevels(pc, settings->fill_levels));
   PetscCall(PCFactorSetShiftType(pc, MAT_SHIFT_NONZERO));
   PetscFunctionReturn(0);
}

static PetscErrorCode solve(int n, const int *row_start, const int *column, double *x, const double *lower,
                            const settings_t *settings, equations_t *eq, outcome_t *outcome)
{
   SNES snes;
   Mat product, near;
   Vec unknown, residual, lowest, highest;
   double *bound;
   PetscInt steps, linear_steps;
   SNESConvergedReason reason;

   PetscFunctionBegin;
   PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, x, &unknown));
   PetscCall(VecCreateSeq(PETSC_COMM_SELF, n, &residual));
   PetscCall(VecDuplicate(residual, &lowest));
   PetscCall(VecDuplicate(residual, &highest));
   PetscCall(VecGetArrayWrite(lowest, &bound));
   for (int i = 0; i < n; i++) bound[i] = lower[i] > -1e300 ? lower[i] : PETSC_NINFINITY; /* none */
   PetscCall(VecRestoreArrayWrite(lowest, &bound));
   PetscCall(VecSet(highest, PETSC_INFINITY));
   PetscCall(make_near(n, row_start, column, &near));
   PetscCall(MatCreateShell(PETSC_COMM_SELF, n, n, n, n, eq, &product));
   PetscCall(MatShellSetOperation(product, MATOP_MULT, (void (*)(void))multiply));

   PetscCall(SNESCreate(PETSC_COMM_SELF, &snes));
   PetscCall(configure(snes, eq, settings));
   PetscCall(SNESSetFunction(snes, residual, evaluate, eq));
   PetscCall(SNESSetJacobian(snes, product, near, linearise, eq));
   PetscCall(SNESVISetVariableBounds(snes, lowest, highest));
   PetscCall(SNESSolve(snes, NULL, unknown));

   PetscCall(SNESGetConvergedReason(snes, &reason));
   PetscCall(SNESGetIterationNumber(snes, &steps));
   PetscCall(SNESGetLinearSolveIterations(snes, &linear_steps));
   outcome->reason = reason;
   outcome->steps = (int)steps;
   outcome->linear_steps = (int)linear_steps;

   PetscCall(SNESDestroy(&snes));
   PetscCall(MatDestroy(&product));
   PetscCall(MatDestroy(&near));
   PetscCall(VecDestroy(&highest));
   PetscCall(VecDestroy(&lowest));
   PetscCall(VecDestroy(&residual));
   PetscCall(VecDestroy(&unknown));
   PetscFunctionReturn(0);
}

/* Start PETSc on this process alone, without options from outside; MPI too if nobody has. 0 when PETSc can be used. */
static int start_petsc(void)
{
   static char name[] = "ehlwave", no_file[] = "-skip_petscrc", no_handler[] = "-no_signal_handler";
   static char *words[] = {name, no_file, no_handler, NULL};
   static char **arguments = words;
   static int count = 3;
   PetscBool is_up, was_up;
   int mpi_up, mpi_over, failure;
   const char *found;
   char *kept = NULL;

   if (PetscInitialized(&is_up)) return 1;
   if (is_up) return 0;
   if (PetscFinalized(&was_up) || was_up) return 1;
   MPI_Initialized(&mpi_up);
   MPI_Finalized(&mpi_over);
   if (mpi_over) return 1;
   if (!mpi_up) {
      if (MPI_Init(NULL, NULL) != MPI_SUCCESS) return 1;
      owns_mpi = 1;
   }
   PETSC_COMM_WORLD = MPI_COMM_SELF;

   found = getenv("PETSC_OPTIONS");
   if (found) kept = strdup(found);
   unsetenv("PETSC_OPTIONS");
   failure = PetscInitialize(&count, &arguments, NULL, NULL) ? 1 : 0;
   if (kept) setenv("PETSC_OPTIONS", kept, 1);
   free(kept);
   if (failure) return 1;
   owns_petsc = 1;
   return PetscOptionsClear(NULL) ? 1 : 0;
}

/* Solve from the guess in x; 0 unless PETSc failed as a program. Only the caller's criterion says converged. */
int ehlwave_solve_inequality(int n, const int *row_start, const int *column, double *x, const double *lower,
                             const settings_t *settings, equations_t *equations, outcome_t *outcome)
{
   memset(outcome, 0, sizeof *outcome);
   if (start_petsc()) return 1;
   return solve(n, row_start, column, x, lower, settings, equations, outcome) ? 1 : 0;
}

/* End what was started here. PETSc cannot be started again in the same process. */
void ehlwave_finish_petsc(void)
{
   int is_over;

   if (owns_petsc) (void)!PetscFinalize();
   owns_petsc = 0;
   if (owns_mpi && !MPI_Finalized(&is_over) && !is_over) MPI_Finalize();
   owns_mpi = 0;
}
