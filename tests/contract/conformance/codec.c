/* A codec that answers what `framegen conform busservo` asks, in C99: cc -o codec codec.c */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "messages.h"
static const char BAD[] = "bad-header", CUT[] = "too-short", NEW[] = "unknown-command", *reason;
static const struct message *found; /* by weigh, as `at`: which byte refuses, or where it ends */
static int at, way, largest, have;
static char line[1 << 18];
static byte held[1 << 17];
static const char *weigh(const byte *p, int n) { /* why these bytes begin no frame; or else NULL */
    int size = n < 3 ? 4 : p[2] + 2, items, room;
    for (at = 0; at < 2; at++) if (at == n || p[at] != 0x55) return at == n ? CUT : BAD;
    if (size < 4 || size > largest) return "length-mismatch";
    if (at = n, n < 4) return CUT;
    for (found = messages; found->name && (found->way != way || found->id != p[3]);) found++;
    if (at = 3, !found->name) return NEW;
    room = size - found->size, items = found->step ? room / found->step : 0;
    if (at = 2, room != items * found->step || items < found->least) return "length-mismatch";
    if (at = 4, found->step && n > 4 && p[4] != items) return "count-mismatch";
    return at = n < size ? n : size, n < size ? CUT : NULL;
}
static int begins(const byte *p, int n, const char *or) { /* a frame, or else `or`, further on? */
    for (const char *why; --n > 0;) if (why = weigh(++p, n), !why || why == or) return 1;
    return 0;
}
static void show(const char *what, const char *name, const byte *p, int n) { /* with its fields */
    const byte *stop = p + n, *each = p;
    for (printf("%s %s ", what, name); each < stop; each++) printf("%02x", *each);
    each = p + (found->step ? 5 : 4), reason = BAD, putchar(' ');
    const char *c = *name ? found->fields : "", *list = c;
    for (; *c && (each < stop || (*c != '1' && *c != ',')); c++)
        if (*c == '1') printf("%d", *each++);
        else if (*c == '2') printf("%d", each[0] + each[1] * 256), each += 2;
        else if (putchar(*c) == '=') list = c; else if (*c == ',') c = list;
    putchar('\n');
}
static int encode(const char *name, char *text) { /* into what is held; 0 bytes for no frame */
    for (found = messages; strcmp(found->name, name);) found++;
    byte *p = held + (found->step ? 5 : 4);
    for (const char *c = found->fields, *list = c; *c; c++)
        if (*c == '=') list = c; else if (*c == ',' && *text == ',') c = list;
        else if ((*c == '1' || *c == '2') && *(text += strcspn(text, "-0123456789"))) {
            long value = strtol(text, &text, 10);
            if (value < 0 || value >> 8 * (*c - '0')) return 0;
            for (int i = '0'; i < *c; i++, value >>= 8) *p++ = (byte)value;
        }
    if (found->step) held[4] = (byte)((p - held - found->size) / found->step);
    held[0] = held[1] = 0x55, held[2] = (byte)(p - held - 2), held[3] = (byte)found->id;
    return way = found->way, (int)(p - held);
}
static void tell(int quiet) { /* what is held, as far as it is certain */
    byte *p = held;
    for (int size = 1; have; p += size, have -= size, size = 1) {
        const char *why = weigh(p, have);
        int all = why == NEW ? p[2] + 2 : 0;
        if (!why) show("message", found->name, p, size = at);
        else if (!quiet && (why == CUT || (all > have && !begins(p, have, NULL)))) break;
        else if (all && all <= have && !begins(p, all, CUT)) show("unknown", "", p, size = all);
        else printf("noise %s %02x\n", reason = have > 1 && !memcmp(p, "UU", 2) ? why : reason, *p);
    }
    if (memmove(held, p, (size_t)have), quiet) puts("quiet"), reason = BAD;
}
int main(void) {
    while (fgets(line, sizeof line, stdin)) {
        const char *verb = strtok(line, " \r\n"), *name = strtok(NULL, " \r\n"), *why;
        largest = *verb == 's' ? atoi(strtok(NULL, " \r\n")) : 257;
        way = *name == 'c', have = 0, reason = BAD;
        if (*verb == 'e') have = encode(name, strtok(NULL, "\r\n"));
        for (char *word; *verb != 'e' && (word = strtok(NULL, " \r\n"));) {
            for (unsigned x; sscanf(word, "%2x", &x) == 1; word += 2) held[have++] = (byte)x;
            if (*verb == 's') tell(*word == 'q');
        }
        if (why = weigh(held, have), !why && at < have) why = "trailing-bytes";
        if (*verb == 'e') why ? (void)puts("refused") : show("frame", "", held, have);
        else if (*verb == 'd' && why) printf("refused %s %d\n", why, at);
        else if (*verb == 'd') show("message", found->name, held, have);
        puts("end"), fflush(stdout);
    }
}
