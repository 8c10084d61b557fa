# Makes trials.csv and expected.csv, what effects_model_test.cc compares with: 20 random designs of
# factors within and between persons, and 12 with factors of three to five levels and few persons,
# analysed by afex, lme4 and lmerTest.
#   Rscript make_designs.R          # Debian: r-cran-afex r-cran-lme4 r-cran-lmertest
# The tests read the two files; R is not needed for them.
suppressMessages({library(afex); library(lme4); library(lmerTest)})
options(contrasts = c("contr.sum", "contr.poly"))
set.seed(20)

# Two groupings of persons, unequal; trials differ in number; some persons lack a condition.
make_design <- function(id) {
  repeat {
    within <- list(a = paste0("a", seq_len(sample(2:4, 1))))
    if (runif(1) < 0.6) within$b <- paste0("b", seq_len(sample(2:3, 1)))
    between <- list()
    if (id > 3) between$g <- paste0("g", seq_len(sample(2:3, 1)))
    if (id > 13) between$h <- paste0("h", seq_len(2))
    if (prod(sapply(c(within, between), length)) <= 36) break
  }
  cells <- expand.grid(within, stringsAsFactors = FALSE)
  groups <- if (length(between)) expand.grid(between, stringsAsFactors = FALSE) else
    data.frame(row.names = 1)
  num_sessions <- if (id %% 4 == 0) 2 else 1
  rows <- list(); person <- 0
  own_scale <- c(3, 1, 0)[id %% 3 + 1]
  for (group in seq_len(max(1, nrow(groups)))) for (member in seq_len(sample(3:7, 1))) {
    person <- person + 1
    level <- rnorm(1, 0, 4)
    own <- lapply(within, function(levels) rnorm(length(levels), 0, own_scale))
    sessions <- rnorm(num_sessions, 0, 1.5)
    for (cell in seq_len(nrow(cells))) {
      missing <- id %% 5 == 0 && member == 1 && cell == 1 && person > 1
      for (session in seq_len(num_sessions)) for (trial in seq_len(sample(1:4, 1))) {
        value <- 100 + level + sum(mapply(function(e, f) e[match(cells[cell, f], within[[f]])],
                                          own, names(within))) + 2 * group * (cell == 2) + cell +
          sessions[session] + rnorm(1, 0, 2)
        if (!missing) rows[[length(rows) + 1]] <- data.frame(
          design = id, person = sprintf("p%02d", person), a = cells$a[cell],
          b = if (is.null(within$b)) "" else cells$b[cell],
          g = if (is.null(between$g)) "" else groups$g[group],
          h = if (is.null(between$h)) "" else groups$h[group],
          session = if (num_sessions == 1) "" else as.character(session),
          value = round(value, 4))
      }
    }
  }
  do.call(rbind, rows)
}

expected <- list()
add <- function(design, analysis, effect, quantity, value)
  expected[[length(expected) + 1]] <<- data.frame(design, analysis, effect, quantity,
                                                   value = sprintf("%.15g", value))

name_effect <- function(effect, order) {
  parts <- strsplit(effect, ":", fixed = TRUE)[[1]]
  paste(parts[order(match(parts, order))], collapse = " x ")
}

add_anova <- function(id, d, within, between) {
  order <- c(within, between)
  means <- aggregate(d["value"], d[c("person", order)], mean)
  num_cells <- prod(sapply(d[within], function(f) length(unique(f))))
  complete <- names(which(table(means$person) == num_cells))
  means <- droplevels(means[means$person %in% complete, ])
  fit <- aov_ez("person", "value", means, within = within,
                between = if (length(between)) between, type = 3,
                anova_table = list(es = "ges", correction = "none"))
  add(id, "anova", "", "persons", length(complete))
  table <- fit$anova_table
  for (row in rownames(table)) {
    effect <- name_effect(row, order)
    add(id, "anova", effect, "f", table[row, "F"])
    add(id, "anova", effect, "df_1", table[row, "num Df"])
    add(id, "anova", effect, "df_2", table[row, "den Df"])
    add(id, "anova", effect, "p", table[row, "Pr(>F)"])
    add(id, "anova", effect, "ges", table[row, "ges"])
  }
  s <- summary(fit$Anova, multivariate = FALSE)
  for (row in rownames(s$pval.adjustments)) {
    if (is.na(s$pval.adjustments[row, "GG eps"])) next  # two levels
    effect <- name_effect(row, order)
    add(id, "anova", effect, "gg", s$pval.adjustments[row, "GG eps"])
    add(id, "anova", effect, "p_gg", s$pval.adjustments[row, "Pr(>F[GG])"])
    add(id, "anova", effect, "hf", min(1, s$pval.adjustments[row, "HF eps"]))
    if (!row %in% rownames(s$sphericity.tests)) next  # too few persons
    add(id, "anova", effect, "mauchly_w", s$sphericity.tests[row, "Test statistic"])
    add(id, "anova", effect, "mauchly_p", s$sphericity.tests[row, "p-value"])
  }
}

# lme4 writes the colon as a point where there are several terms.
part_of <- function(grp) ifelse(grepl("^person[:.]", grp), sub("^person[:.]", "", grp), "1")
is_session <- function(grp) grepl("^person[:.]session", grp)

# Three to five levels, five to nine persons (few for correlations), trials in equal or different
# numbers: the person's deviations at the levels have one variance.
make_levels <- function(id) {
  levels <- 3 + id %% 3
  cells <- data.frame(a = paste0("a", seq_len(levels)))
  if (id %% 2 == 0) cells <- merge(cells, data.frame(b = paste0("b", 1:2)))
  if (is.null(cells$b)) cells$b <- ""
  rows <- list()
  for (person in seq_len(5 + id %% 5)) {
    level <- rnorm(1, 0, 4); own <- rnorm(levels, 0, if (id %% 4 == 0) 0.5 else 2.5)
    for (cell in seq_len(nrow(cells))) for (trial in seq_len(if (id %% 3 == 0) sample(2:5, 1) else 4))
      rows[[length(rows) + 1]] <- data.frame(
        design = id, person = sprintf("p%02d", person), a = cells$a[cell], b = cells$b[cell],
        g = "", h = "", session = "", value = round(50 + level +
          own[match(cells$a[cell], paste0("a", seq_len(levels)))] + cell + rnorm(1, 0, 2), 4))
  }
  do.call(rbind, rows)
}

# The ladder of effects_model.h with lme4.
fit_ladder <- function(d, within, between) {
  own <- character(0); names_of <- "level of persons"
  for (f in within) {
    coding <- contr.sum(nlevels(d[[f]]))
    for (k in seq_len(ncol(coding))) {
      column <- paste0("own_", f, k)
      d[[column]] <- coding[as.integer(d[[f]]), k]
      own <- c(own, column); names_of <- c(names_of, paste0(f, ": ", levels(d[[f]])[k]))
    }
  }
  names(names_of) <- c("1", own)
  own <- c("1", own)
  fixed <- paste("value ~", paste(c(within, between), collapse = " * "))
  # The default stops after three or four digits.
  control <- lmerControl(optimizer = "bobyqa", optCtrl = list(rhoend = 1e-8, maxfun = 1e5),
                         calc.derivs = FALSE, check.conv.singular = "ignore")
  fit_with <- function(random, ...) suppressWarnings(suppressMessages(lmer(
    as.formula(paste(fixed, "+", paste(random, collapse = " + "))), d, ...)))
  # No optimiser that looks at values alone finds the last digits; two Newton steps do.
  polish <- function(model, random) {
    theta <- getME(model, "theta"); deviance_of <- fit_with(random, devFunOnly = TRUE)
    for (step in 1:2) {
      hessian <- optimHess(theta, deviance_of, control = list(ndeps = rep(1e-3, length(theta))))
      theta <- theta - solve(hessian, numDeriv::grad(deviance_of, theta))
    }
    fit_with(random, start = theta, control = lmerControl(optimizer = NULL, calc.derivs = FALSE))
  }
  fit <- function(random) tryCatch({
    model <- fit_with(random, control = control)
    if (isSingular(model, 1e-4)) model else polish(model, random)
  }, error = function(e) NULL)
  sessions <- if (any(d$session != "")) "(1 | person:session)"
  separate <- function(parts) vapply(parts, function(part)
    if (part == "1") "(1 | person)" else paste0("(1 | person:", part, ")"), "")
  model <- NULL; correlated <- FALSE
  if (length(own) > 1 && length(own) <= 6 && length(unique(d$person)) > length(own)) {
    model <- fit(c(paste0("(", paste(own, collapse = " + "), " | person)"), sessions))
    correlated <- !is.null(model) && !isSingular(model, 1e-4)
  }
  if (!correlated) own <- c("1", within)
  while (!correlated && length(own) + length(sessions) > 0) {
    model <- fit(c(separate(own), sessions))
    if (is.null(model)) { if (length(own) == 1) stop("no fit"); own <- "1"; next }
    if (!isSingular(model, 1e-4)) break
    sds <- as.data.frame(VarCorr(model)); sds <- sds[sds$grp != "Residual", ]
    zero <- sds$sdcor < 1e-4 * sigma(model)
    if (any(zero & is_session(sds$grp))) sessions <- NULL
    own <- setdiff(own, part_of(sds$grp)[zero & !is_session(sds$grp)])
  }
  list(model = model, correlated = correlated, names_of = names_of)
}

add_model <- function(id, d, within, between) {
  ladder <- fit_ladder(d, within, between); model <- ladder$model
  add(id, "model", "", "correlated", as.numeric(ladder$correlated))
  add(id, "model", "", "reml", as.numeric(-2 * logLik(model)))
  add(id, "model", "", "sigma", sigma(model))
  sds <- as.data.frame(VarCorr(model))
  sds <- sds[sds$grp != "Residual" & is.na(sds$var2), ]
  for (row in seq_len(nrow(sds))) {
    part <- part_of(sds$grp[row])
    add(id, "model", if (is_session(sds$grp[row])) "level of sessions" else
      if (ladder$correlated) ladder$names_of[[if (sds$var1[row] == "(Intercept)") "1" else
        sds$var1[row]]] else if (part == "1") "level of persons" else paste("persons x", part),
      "sd", sds$sdcor[row])
  }
  x <- getME(model, "X"); assign <- attr(model.matrix(terms(model), model.frame(model)), "assign")
  labels <- attr(terms(model), "term.labels")
  for (k in seq_along(labels)) {
    l <- diag(ncol(x))[which(assign == k), , drop = FALSE]
    test <- contestMD(model, l)
    effect <- name_effect(labels[k], c(within, between))
    add(id, "model", effect, "f", test[["F value"]])
    add(id, "model", effect, "df_2", test[["DenDF"]])
  }
  cells <- interaction(d[within], sep = ", ", lex.order = TRUE, drop = TRUE)
  groups <- if (length(between)) interaction(d[between], drop = TRUE) else factor(rep(1, nrow(d)))
  for (cell in levels(cells)) {
    # Mean over the groups, each counted once.
    rows <- sapply(levels(groups), function(g) which(cells == cell & groups == g)[1])
    test <- contest1D(model, colMeans(x[rows, , drop = FALSE]))
    add(id, "model", cell, "mean", test[["Estimate"]])
    add(id, "model", cell, "se", test[["Std. Error"]])
    add(id, "model", cell, "df", test[["df"]])
  }
}

designs <- c(lapply(1:20, make_design), lapply(21:32, make_levels))
for (id in seq_along(designs)) {
  d <- designs[[id]]
  within <- Filter(function(f) any(d[[f]] != ""), c("a", "b"))
  between <- Filter(function(f) any(d[[f]] != ""), c("g", "h"))
  for (f in c(within, between)) d[[f]] <- factor(d[[f]])
  suppressMessages(suppressWarnings(add_anova(id, d, within, between)))
  add_model(id, d, within, between)
}
write.csv(do.call(rbind, designs), "trials.csv", row.names = FALSE, quote = FALSE)
expected <- do.call(rbind, expected)
expected$effect <- gsub(", ", "/", expected$effect, fixed = TRUE)  # no comma in a cell
write.csv(expected, "expected.csv", row.names = FALSE, quote = FALSE)
