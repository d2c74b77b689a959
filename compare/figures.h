/* critvel-compare figures: the pictures of a case file, in a folder. */
#ifndef CRITVEL_COMPARE_FIGURES_H
#define CRITVEL_COMPARE_FIGURES_H

/* The command as a whole, argv[1] being "figures"; returns the exit status: 0 all drawn, 1 some picture could
 * not be computed, 2 bad usage or input, 3 no gnuplot, or a folder that cannot be written to. Its answer is
 * the list of the pictures drawn. */
int cmp_figures_main(int argc, char **argv);

#endif
