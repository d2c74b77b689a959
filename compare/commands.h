/* Commands of critvel-compare with options of their own. Each is the command as a whole, argv[1] being its
 * name, and returns the exit status: 0 everything agrees, 1 a disagreement or an undecided result, 2 bad
 * usage or bad input, 3 internal or I/O failure. */
#ifndef CRITVEL_COMPARE_COMMANDS_H
#define CRITVEL_COMPARE_COMMANDS_H

int cmp_convergence_main(int argc, char **argv); /* stability limits as the damping falls */
int cmp_lines_main(int argc, char **argv);       /* instability lines */
int cmp_roots_main(int argc, char **argv);       /* mass-induced frequencies at one velocity */

#endif
