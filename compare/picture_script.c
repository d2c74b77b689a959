/* What the gnuplot scripts of all pictures have in common. */
#include <string.h>

#include "common/cli.h"
#include "compare/picture.h"

/* Dark to light, each with its own dash, so that a print without colour still tells them apart. */
static const char STYLES[] =
    "# lines by number: restyle here\n"
    "set style line 1 linecolor rgb '#000000' linewidth 1.6 dashtype solid   pointtype 7 pointsize 0.5\n"
    "set style line 2 linecolor rgb '#c03020' linewidth 1.6 dashtype (10,4)    pointtype 5 pointsize 0.5\n"
    "set style line 3 linecolor rgb '#2060c0' linewidth 1.6 dashtype (2,2.5) pointtype 9 pointsize 0.6\n"
    "set style line 4 linecolor rgb '#209050' linewidth 1.6 dashtype (10,3,2,3) pointtype 11 pointsize 0.6\n"
    "# marks of velocities: true, false, pseudocritical\n"
    "set style line 5 linecolor rgb '#606060' linewidth 1 dashtype (14,6)\n"
    "set style line 6 linecolor rgb '#606060' linewidth 1 dashtype (14,4,2,4)\n"
    "set style line 7 linecolor rgb '#404040' linewidth 1.2 dashtype (3,4)\n"
    "# axes through 0, and points\n"
    "set style line 8 linecolor rgb '#a0a0a0' linewidth 0.6 dashtype solid\n"
    "set style line 9 linecolor rgb '#000000' linewidth 1 pointtype 6 pointsize 0.6\n";

/* gnuplot wants letters, digits and '_' only in what it puts before the ids of an SVG. */
static const char *svg_name(char out[CMP_PICTURE_NAME], const char *name)
{
    snprintf(out, CMP_PICTURE_NAME, "%s", name);
    for (char *c = out; *c != '\0'; c++)
        if (*c == '-' || *c == '.')
            *c = '_';
    return out;
}

void cmp_script_begin(const cmp_picture *p, double width, double height)
{
    FILE *s = p->script;
    char id[CMP_PICTURE_NAME];
    fprintf(s, "# %s\n# critvel-compare %s figures. Drawn again by: gnuplot %s.gp\n", p->shows, CV_VERSION,
            p->name);
    fprintf(s, "# or, as PDF: gnuplot -e \"format = 'pdf'\" %s.gp\n", p->name);
    fprintf(s, "set encoding utf8\nif (!exists('format')) format = 'svg'\nif (format eq 'pdf') {\n");
    fprintf(s,
            "    set terminal pdfcairo enhanced color size %gcm, %gcm font 'DejaVu Sans,7' linewidth 0.8\n   "
            " size = 7\n",
            width, height);
    fprintf(s, "} else {\n    set terminal svg enhanced size %.0f, %.0f font 'DejaVu Sans,10' name '%s' ",
            width * 60, height * 60, svg_name(id, p->name));
    fprintf(s, "background rgb 'white'\n    size = 10\n}\nset output '%s.' . format\n\n%s\n", p->name,
            STYLES);
    fprintf(s, "set border linewidth 0.7\nset tics scale 0.6\nset clip two\n");
    fprintf(s, "set key samplen 2.5 spacing 1.1 noautotitle\n");
}

void cmp_script_text(FILE *script, const char *text)
{
    fputc('\'', script);
    for (; *text != '\0'; text++) {
        if (strchr("_^{}@&~\\", *text) != NULL)
            fputc('\\', script);
        if (*text == '\'')
            fputc('\'', script);
        fputc(*text, script);
    }
    fputc('\'', script);
}
