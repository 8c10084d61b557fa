options(digits = 10, contrasts = c("contr.sum", "contr.poly"))
# Text that a spreadsheet would run as a formula stands behind an apostrophe in the tables.
unguard <- function(d) {
  for (f in names(d)) if (is.character(d[[f]]))
    d[[f]] <- sub("^'(?='*[-=+@[:cntrl:]])", "", d[[f]], perl = TRUE)
  d
}
read_table <- function(file, text) {
  d <- unguard(read.csv(file, check.names = FALSE, na.strings = "", quote = "\"",
                        colClasses = setNames(rep("character", length(text)), text)))
  for (f in intersect(c(factors, groups), names(d)))
    d[[f]] <- factor(d[[f]], levels = levels_of[[f]])
  if (session %in% names(d)) d$own_session <- factor(d[[session]], levels = sessions)
  d
}
d <- read_table("tidy.csv", c("person", "trial", factors, groups, if (length(sessions)) session,
                              "measure"))
quoted <- function(names) paste0("`", gsub("([`\\\\])", "\\\\\\1", names), "`")
has <- function(package) requireNamespace(package, quietly = TRUE)

rows <- list()
add <- function(measure, analysis, effect, estimate = NA, standard_error = NA, low = NA, high = NA,
                value = NA, df_1 = NA, df_2 = NA, p = NA, p_holm = NA, effect_size = NA) {
  rows[[length(rows) + 1]] <<- data.frame(measure, analysis, effect, estimate, standard_error, low,
    high, value, df_1, df_2, p, p_holm, effect_size, stringsAsFactors = FALSE)
}

# Type III: what the columns of an effect explain beyond all others. Within effects are orthonormal
# contrasts of the conditions, groups are coded to sum to zero.
test_anova <- function(m, y, who) {
  n <- nrow(y); k <- ncol(y)
  if (length(groups) && any(table(who[groups]) < 2)) return()
  x <- if (length(groups)) model.matrix(reformulate(paste(quoted(groups), collapse = " * ")), who)
       else matrix(1, n, 1)
  assign <- if (length(groups)) attr(x, "assign") else 0
  labels <- if (length(groups)) attr(terms(reformulate(paste(quoted(groups), collapse = " * "))),
                                     "term.labels") else character(0)
  sets <- unlist(lapply(seq_along(c(factors, groups)), function(size)
    combn(c(factors, groups), size, simplify = FALSE)), recursive = FALSE)
  contrasts_of <- function(set) {
    m <- matrix(1, 1, 1)
    for (f in factors) {
      own <- length(levels_of[[f]])
      helmert <- contr.helmert(own)
      m <- m %x% (if (f %in% set) sweep(helmert, 2, sqrt(colSums(helmert^2)), "/")
                  else matrix(1 / sqrt(own), own, 1))
    }
    m
  }
  error_of <- function(z) crossprod(lm.fit(x, z)$residuals)
  within_sets <- c(list(character(0)), Filter(function(s) !any(s %in% groups), sets))
  all_errors <- sum(sapply(within_sets, function(s) sum(diag(error_of(y %*% contrasts_of(s))))))
  for (set in sets) {
    own_groups <- intersect(groups, set); own_factors <- intersect(factors, set)
    z <- y %*% contrasts_of(own_factors)
    columns <- if (length(own_groups) == 0) 1 else
      which(assign == match(paste(quoted(own_groups), collapse = ":"),
                            sapply(strsplit(labels, ":", fixed = TRUE), function(part)
                              paste(ifelse(grepl("^`", part), part, quoted(part)), collapse = ":"))))
    e <- error_of(z)
    without <- x[, -columns, drop = FALSE]
    h <- (if (ncol(without)) crossprod(lm.fit(without, z)$residuals) else crossprod(z)) - e
    d <- ncol(z); df_error <- n - ncol(x)
    ss <- sum(diag(h)); ss_error <- sum(diag(e))
    if (ss_error < 1e-20 * sum(y^2)) next
    df_1 <- d * length(columns); df_2 <- d * df_error
    f <- ss / df_1 / (ss_error / df_2); ges <- ss / (ss + all_errors)
    effect <- paste(set, collapse = " x ")
    put <- function(analysis, epsilon) add(m, analysis, effect, value = f, df_1 = epsilon * df_1,
      df_2 = epsilon * df_2, p = pf(f, epsilon * df_1, epsilon * df_2, lower.tail = FALSE),
      effect_size = ges)
    put(if (length(groups)) "mixed ANOVA (type III)" else "repeated-measures ANOVA", 1)
    if (length(own_factors) == 0) next
    gg <- min(1, sum(diag(e))^2 / (d * sum(e^2)))
    put("ANOVA, Greenhouse-Geisser", gg)
    hf <- if (d == 1) 1 else ((df_error + 1) * d * gg - 2) / (d * (df_error - d * gg))
    if (d == 1 || df_error > d * gg) put("ANOVA, Huynh-Feldt", max(gg, min(1, hf)))
    if (d > 1 && df_error >= d) {
      cat("Mauchly's test:", effect, "\n")
      print(try(mauchly.test(lm(z ~ x - 1)), silent = TRUE))
    }
  }
}

test_groups <- function(m, y, who) {
  own <- rowMeans(y); found <- list()
  for (g in groups) for (pair in combn(levels_of[[g]], 2, simplify = FALSE)) {
    a <- own[who[[g]] == pair[1]]; b <- own[who[[g]] == pair[2]]
    if (length(a) < 2 || length(b) < 2) next
    t <- t.test(b, a)
    pooled <- sqrt((sum((a - mean(a))^2) + sum((b - mean(b))^2)) / (length(a) + length(b) - 2))
    found[[paste0(g, ": ", pair[2], " minus ", pair[1])]] <- list(t = t, d = unname(
      (mean(b) - mean(a)) / pooled), difference = mean(b) - mean(a))
  }
  holm <- p.adjust(sapply(found, function(one) one$t$p.value), "holm")
  for (effect in names(found)) with(found[[effect]], add(m, "Welch t test of groups", effect,
    difference, t$stderr, t$conf.int[1], t$conf.int[2], t$statistic, t$parameter, p = t$p.value,
    p_holm = holm[[effect]], effect_size = d))
}

# Exact, ties included: the distribution of all signs on the ranks that occurred.
wilcoxon <- function(difference, scale) {
  difference <- difference[abs(difference) > 8 * .Machine$double.eps * scale]
  if (length(difference) == 0) return(NULL)
  twice <- 2 * rank(round(abs(difference) / scale, 13))
  counts <- 1
  for (r in twice) counts <- c(counts, rep(0, r)) + c(rep(0, r), counts)
  w <- sum(twice[difference > 0]); at <- seq_along(counts) - 1
  tail <- min(sum(counts[at <= w]), sum(counts[at >= w])) / sum(counts)
  list(w = w / 2, p = min(1, 2 * tail), r = 2 * w / sum(twice) - 1)
}

# Bias-corrected and accelerated, from draws of its own.
bca <- function(values) {
  n <- length(values)
  if (n < 2 || sd(values) == 0) return(c(NA, NA))
  draws <- colMeans(matrix(sample(values, 9999 * n, TRUE), n))
  z <- qnorm(mean(draws < mean(values)) + mean(draws == mean(values)) / 2)
  left <- (sum(values) - values) / (n - 1)
  a <- sum((mean(left) - left)^3) / (6 * sum((mean(left) - left)^2)^1.5)
  q <- z + qnorm(c(0.025, 0.975))
  unname(quantile(draws, pnorm(z + q / (1 - a * q))))
}

test_pairs <- function(m, y) {
  names <- colnames(y); pairs <- combn(names, 2, simplify = FALSE); n <- nrow(y)
  tests <- lapply(pairs, function(pair) {
    difference <- y[, pair[2]] - y[, pair[1]]
    list(effect = paste(pair[2], "-", pair[1]), difference = difference,
         t = if (sd(difference) > 0) t.test(difference),
         w = wilcoxon(difference, max(abs(y[, pair]))))
  })
  holm_t <- p.adjust(sapply(tests, function(one) if (is.null(one$t)) NA else one$t$p.value), "holm")
  holm_w <- p.adjust(sapply(tests, function(one) if (is.null(one$w)) NA else one$w$p), "holm")
  for (i in seq_along(tests)) with(tests[[i]], {
    se <- sd(difference) / sqrt(n); d_z <- mean(difference) / sd(difference)
    if (!is.null(t)) add(m, "paired t test", effect, mean(difference), se, t$conf.int[1],
      t$conf.int[2], t$statistic, t$parameter, p = t$p.value, p_holm = holm_t[i], effect_size = d_z)
    if (!is.null(w)) add(m, "Wilcoxon signed ranks", effect, value = w$w, p = w$p,
                         p_holm = holm_w[i], effect_size = w$r)
    interval <- bca(difference)
    add(m, "BCa bootstrap of the mean", effect, mean(difference), low = interval[1],
        high = interval[2])
    bound <- equal_within[m]
    if (!is.na(bound) && !is.null(t)) {
      low <- t.test(difference, mu = -bound, alternative = "greater")
      high <- t.test(difference, mu = bound, alternative = "less")
      worse <- if (low$p.value > high$p.value) low else high
      interval <- t.test(difference, conf.level = 0.9)$conf.int
      add(m, "equivalence, two one-sided t tests", effect, mean(difference), se, interval[1],
          interval[2], worse$statistic, n - 1, p = worse$p.value, effect_size = d_z)
    }
  })
}

# The default optimiser stops after three or four digits.
fit_by <- function(formula, data, optimizer, options, start = NULL) tryCatch(suppressWarnings(
  suppressMessages(lmerTest::lmer(as.formula(formula), data, start = start,
    control = lme4::lmerControl(optimizer = optimizer, calc.derivs = FALSE,
                                check.conv.singular = "ignore", optCtrl = options)))),
  error = function(e) NULL)
bobyqa <- list(rhoend = 1e-12, maxfun = 1e5)
# A search that ends on the boundary may have missed a better fit beside it.
fit <- function(formula, data) {
  model <- fit_by(formula, data, "bobyqa", bobyqa)
  if (is.null(model) || !lme4::isSingular(model, 1e-4)) return(model)
  other <- fit_by(formula, data, "nloptwrap", list(xtol_abs = 1e-10, ftol_abs = 1e-10))
  if (is.null(other) || lme4::REMLcrit(other) >= lme4::REMLcrit(model)) return(model)
  fit_by(formula, data, "bobyqa", bobyqa, start = lme4::getME(other, "theta"))
}
spreads <- function(model) {
  v <- as.data.frame(lme4::VarCorr(model))
  v <- v[v$grp != "Residual" & is.na(v$var2), ]
  v$is_session <- grepl("^person[:.]own_session", v$grp)  # a point where there are several terms
  of_factor <- grepl("^person[:.]v", v$grp)
  v$key <- ifelse(of_factor, sub("^person[:.]", "", v$grp),
                  ifelse(v$var1 == "(Intercept)", "1", v$var1))
  v
}

# The fullest random part that is not singular: with correlations, one variance for each factor,
# without zeros. own: columns that correlate; parts: terms that do not, by key.
descend <- function(fixed, data, own, parts, with_sessions) {
  sessions_part <- if (with_sessions) "(1 | person:own_session)"
  if (length(own) > 1 && length(own) <= 6 && length(unique(data$person)) > length(own)) {
    model <- fit(paste(fixed, "+", paste(c(paste0("(", paste(own, collapse = " + "), " | person)"),
                                           sessions_part), collapse = " + ")), data)
    if (!is.null(model) && !lme4::isSingular(model, 1e-4)) return(model)
  }
  while (length(parts) + length(sessions_part) > 0) {
    model <- fit(paste(fixed, "+", paste(c(parts, sessions_part), collapse = " + ")), data)
    if (is.null(model)) { if (length(parts) < 2) return(NULL); parts <- parts["1"]; next }
    if (!lme4::isSingular(model, 1e-4)) return(model)
    v <- spreads(model); zero <- v$sdcor < 1e-4 * sigma(model)
    if (any(zero & v$is_session)) sessions_part <- NULL
    parts <- parts[setdiff(names(parts), v$key[zero & !v$is_session])]
  }
  NULL
}

fit_effects <- function(m, trials, within, quantity = NULL) {
  analysis <- if (is.null(quantity)) "mixed model (REML), all factors" else
    paste0("mixed model (REML), ", quantity, " as a quantity")
  variables <- c(within, groups)
  if (length(variables) == 0 || (length(groups) && any(table(unique(
    trials[c("person", groups)])[groups]) < 2))) return()
  data <- data.frame(person = trials$person, value = trials$value)
  if (length(sessions)) data$own_session <- trials$own_session
  own <- "1"; names_of <- c("1" = "level of persons"); scale <- 1
  parts <- c("1" = "(1 | person)")
  for (i in seq_along(variables)) {
    f <- variables[i]; column <- paste0("v", i)
    if (identical(f, quantity)) {
      x <- trials[[paste0(f, "_number")]]
      scale <- sqrt(mean((x - mean(x))^2))
      data[[column]] <- (x - mean(x)) / scale
      own <- c(own, column); names_of[column] <- paste("slope over", f)
      parts[column] <- paste0("(0 + ", column, " | person)")
    } else {
      data[[column]] <- trials[[f]]
      if (f %in% within) {
        parts[column] <- paste0("(1 | person:", column, ")")
        names_of[column] <- paste("persons x", f)
      }
      if (f %in% within) for (k in seq_len(nlevels(trials[[f]]) - 1)) {
        coded <- paste0("own", i, "_", k)
        data[[coded]] <- contr.sum(nlevels(trials[[f]]))[as.integer(trials[[f]]), k]
        own <- c(own, coded); names_of[coded] <- paste0(f, ": ", levels(trials[[f]])[k])
      }
    }
  }
  with_sessions <- length(sessions) > 0 &&
    any(rowSums(table(data$person, data$own_session) > 0) > 1)
  fixed <- paste("value ~", paste0("v", seq_along(variables), collapse = " * "))
  model <- descend(fixed, data, own, parts, with_sessions)
  if (is.null(model)) return()
  x <- lme4::getME(model, "X")
  if (!is.null(quantity)) {
    test <- lmerTest::contest1D(model, replace(numeric(ncol(x)), 2, 1 / scale))
    half <- qt(0.975, test[["df"]]) * test[["Std. Error"]]
    t <- (test[["Estimate"]] - if (is.na(slope_of[m])) 0 else slope_of[m]) / test[["Std. Error"]]
    add(m, "mixed model (REML)", paste("slope over", quantity), test[["Estimate"]],
        test[["Std. Error"]], test[["Estimate"]] - half, test[["Estimate"]] + half, t, test[["df"]],
        p = 2 * pt(-abs(t), test[["df"]]))
    if (!length(groups)) return()
  }
  assign <- attr(model.matrix(terms(model), model.frame(model)), "assign")
  labels <- attr(terms(model), "term.labels")
  for (k in seq_along(labels)) {
    test <- lmerTest::contestMD(model, diag(ncol(x))[which(assign == k), , drop = FALSE])
    indices <- sort(as.integer(sub("v", "", strsplit(labels[k], ":", fixed = TRUE)[[1]])))
    add(m, analysis, paste(variables[indices], collapse = " x "), value = test[["F value"]],
        df_1 = test[["NumDF"]], df_2 = test[["DenDF"]], p = test[["Pr(>F)"]])
  }
  if (is.null(quantity)) {
    cells <- if (length(within)) interaction(trials[within], sep = ", ", lex.order = TRUE) else
      factor(rep("all trials", nrow(trials)))
    by_group <- if (length(groups)) interaction(trials[groups]) else factor(rep(1, nrow(trials)))
    for (cell in levels(cells)) {
      first <- sapply(levels(by_group), function(g) which(cells == cell & by_group == g)[1])
      test <- lmerTest::contest1D(model, colMeans(x[first, , drop = FALSE]))
      half <- qt(0.975, test[["df"]]) * test[["Std. Error"]]
      add(m, analysis, paste("mean in", cell), test[["Estimate"]], test[["Std. Error"]],
          test[["Estimate"]] - half, test[["Estimate"]] + half, df_1 = test[["df"]])
    }
  }
  v <- spreads(model)
  for (i in seq_len(nrow(v))) {
    name <- if (v$is_session[i]) "level of sessions" else names_of[[v$key[i]]]
    add(m, analysis, paste("SD of", name),
        v$sdcor[i] / (if (grepl("^slope over", name)) scale else 1))
  }
  add(m, analysis, "SD of trials", sigma(model))
}

fit_line <- function(m, trials, f) {
  trials$x <- trials[[paste0(f, "_number")]]
  slopes <- sapply(split(trials, trials$person), function(own)
    if (length(unique(own$x)) > 1) coef(lm(value ~ x, own))[["x"]] else NA)
  slopes <- slopes[!is.na(slopes)]; effect <- paste("slope over", f)
  if (length(slopes) > 1 && sd(slopes) > 0) {
    t <- t.test(slopes, mu = if (is.na(slope_of[m])) 0 else slope_of[m])
    add(m, "persons' slopes, t test", effect, mean(slopes), t$stderr, t$conf.int[1], t$conf.int[2],
        t$statistic, t$parameter, p = t$p.value)
    interval <- bca(slopes[unique(trials$person)[unique(trials$person) %in% names(slopes)]])
    add(m, "persons' slopes, BCa bootstrap", effect, mean(slopes), low = interval[1],
        high = interval[2])
  }
  if (has("lme4") && has("lmerTest")) fit_effects(m, trials, f, f)
}

# Intraclass correlations after Shrout and Fleiss, intervals after McGraw and Wong.
test_retest <- function(m, trials) {
  # A session that is a factor, too, is no condition within itself.
  conditions <- Filter(function(f) any(as.character(trials[[f]]) != trials[[session]]), factors)
  cell <- interaction(trials[c(conditions, "own_session")], sep = ", ", lex.order = TRUE)
  y <- tapply(trials$value, list(factor(trials$person, unique(trials$person)), cell), mean)
  y <- y[complete.cases(y), , drop = FALSE]; n <- nrow(y); k <- length(sessions)
  if (n < 2 || k < 2) return()
  own <- sapply(seq_len(k), function(s) rowMeans(y[, seq(s, ncol(y), k), drop = FALSE]))
  grand <- mean(own)
  ms_p <- k * sum((rowMeans(own) - grand)^2) / (n - 1)
  ms_t <- n * sum((colMeans(own) - grand)^2) / (k - 1)
  ms_w <- sum((own - rowMeans(own))^2) / (n * (k - 1))
  ms_e <- (n * (k - 1) * ms_w - (k - 1) * ms_t) / ((n - 1) * (k - 1))
  icc2 <- (ms_p - ms_e) / (ms_p + (k - 1) * ms_e + k * (ms_t - ms_e) / n)
  share <- max(icc2, 0)  # a variance is not negative
  a <- k * share / (n * (1 - share)); b <- 1 + k * share * (n - 1) / (n * (1 - share))
  v <- (a * ms_t + b * ms_e)^2 / ((a * ms_t)^2 / (k - 1) + (b * ms_e)^2 / ((n - 1) * (k - 1)))
  f <- qf(0.975, n - 1, v); g <- qf(0.975, v, n - 1); rest <- k * ms_t + (k * n - k - n) * ms_e
  add(m, "test-retest", "ICC(2,1)", icc2, low = n * (ms_p - f * ms_e) / (f * rest + n * ms_p),
      high = n * (g * ms_p - ms_e) / (rest + n * g * ms_p))
  f0 <- ms_p / ms_e; df_e <- (n - 1) * (k - 1)
  low <- f0 / qf(0.975, n - 1, df_e); high <- f0 * qf(0.975, df_e, n - 1)
  add(m, "test-retest", "ICC(3,1)", (f0 - 1) / (f0 + k - 1), low = (low - 1) / (low + k - 1),
      high = (high - 1) / (high + k - 1))
  df <- n * (k - 1)
  add(m, "test-retest", "SEM", sqrt(ms_w), low = sqrt(df * ms_w / qchisq(0.975, df)),
      high = sqrt(df * ms_w / qchisq(0.025, df)))
  add(m, "test-retest", "minimal detectable change", qnorm(0.975) * sqrt(2 * ms_w))
  for (s in seq_len(k)[-1]) {
    difference <- own[, s] - own[, s - 1]; t <- t.test(difference)
    add(m, "test-retest, shift (paired t test)",
        paste("session", sessions[s], "minus", sessions[s - 1]), mean(difference), t$stderr,
        t$conf.int[1], t$conf.int[2], t$statistic, t$parameter, p = t$p.value,
        effect_size = mean(difference) / sd(difference))
  }
}

# Each opening as a multiple of the aperture by four criteria, persons left out in turn.
test_openings <- function(o) {
  o$cell <- if (length(factors)) interaction(o[factors]) else factor(rep(1, nrow(o)))
  x <- if (length(quantities)) o[[paste0(quantities[1], "_number")]] else rep(NA, nrow(o))
  spread <- function(t, both) {
    ss <- 0; df <- 0
    for (field in if (both) c("open", "closed") else "open")
      for (own in split(t[[field]], paste(t$person, t$cell, sep = "\r"))) {
        ss <- ss + sum((own - mean(own))^2); df <- df + length(own) - 1
      }
    sqrt(ss / df)
  }
  persons_f <- function(t) {
    t$open <- t$open - ave(t$open, t$cell) + mean(t$open)
    own <- split(t$open, t$person); n <- sapply(own, length)
    between <- sum(n * (sapply(own, mean) - mean(t$open))^2) / (length(own) - 1)
    sqrt(between / (sum(sapply(own, function(v) sum((v - mean(v))^2))) / (sum(n) - length(own))))
  }
  # With two digits every opening is the aperture, up to rounding.
  log_of <- function(ratio) if (isTRUE(abs(log(ratio)) < 1e-12)) 0 else log(ratio)
  d_prime <- function(t) mean(tapply(t$open - t$closed, t$person, mean)) / spread(t, TRUE)
  slopes <- function(t) unlist(lapply(split(t, t$person), function(own)
    if (length(unique(own$x)) > 1) coef(lm(open ~ x, own))[["x"]]))
  slope <- function(t) mean(slopes(t)) / spread(t, FALSE)
  criteria <- list(persons = persons_f, separation = d_prime, slope = slope, robustness = d_prime)
  view <- function(id, digit = NULL) {
    own <- o[o$opening == id, ]
    suffix <- if (is.null(digit)) "" else paste0("_without_", digit)
    data.frame(trial = own$trial, person = own$person, cell = own$cell, x = x[o$opening == id],
               open = own[[paste0("open", suffix)]], closed = own[[paste0("closed", suffix)]],
               stringsAsFactors = FALSE)
  }
  both <- function(a, b) {
    ok <- is.finite(a$open) & is.finite(a$closed) & is.finite(b$open) & is.finite(b$closed)
    list(a[ok, ], b[ok, ])
  }
  digits <- sub("open_without_", "", grep("^open_without_", names(o), value = TRUE))
  worst <- function(id) {
    kept <- sapply(digits, function(digit) {
      pair <- both(view(id, digit), view(id))
      if (nrow(pair[[1]])) d_prime(pair[[1]]) / d_prime(pair[[2]]) else NA
    })
    digits[which.min(kept)]
  }
  ids <- unique(o$opening); analysis <- "reliability against the aperture, jackknife"
  found <- list()
  for (id in ids[-1]) for (criterion in names(criteria)) {
    a <- view(id); b <- view(ids[1])
    if (criterion == "robustness") {
      # With two digits nothing is left of an opening without one of them.
      without <- c(worst(id), worst(ids[1]))
      if (length(without) < 2) next
      a <- view(id, without[1]); b <- view(ids[1], without[2])
    }
    if (criterion == "slope") {
      aperture <- both(b, b)[[1]]
      s <- if (length(quantities)) slopes(aperture) else NULL
      if (length(s) < 2 || !(mean(s) > 0 && t.test(s)$p.value < 0.05)) next
    }
    pair <- both(a, b); persons <- unique(pair[[1]]$person); n <- length(persons)
    if (n < 5) next
    ratio <- function(keep) log_of(criteria[[criterion]](pair[[1]][pair[[1]]$person %in% keep, ]) /
                                criteria[[criterion]](pair[[2]][pair[[2]]$person %in% keep, ]))
    all <- ratio(persons); left <- sapply(persons, function(p) ratio(setdiff(persons, p)))
    if (!all(is.finite(c(all, left))) || length(unique(left)) == 1) next
    se <- sqrt((n - 1) / n * sum((left - mean(left))^2)); t <- qt(0.975, n - 1)
    found[[length(found) + 1]] <- list(measure = paste0("open_", id, "_m"), effect = criterion,
      estimate = exp(all), low = exp(all - t * se), high = exp(all + t * se),
      p = 2 * pt(-abs(all / se), n - 1))
  }
  holm <- p.adjust(vapply(found, function(one) one$p, 0), "holm")
  for (i in seq_along(found)) with(found[[i]], add(measure, analysis, effect, estimate, low = low,
                                                   high = high, p = p, p_holm = holm[i]))
}

set.seed(1)
stored <- if (file.exists("../statistics.csv"))
  unguard(read.csv("../statistics.csv", check.names = FALSE, na.strings = "",
                   stringsAsFactors = FALSE))
for (m in if (is.null(stored)) unique(d$measure) else intersect(unique(d$measure), stored$measure)) {
  trials <- d[d$measure == m & !is.na(d$value), ]
  if (nrow(trials) == 0) next
  cat("\n==== ", m, " ====\n", sep = "")
  if (length(sessions)) test_retest(m, trials)
  if (length(factors) + length(groups) == 0) next
  cell <- if (length(factors)) interaction(trials[factors], sep = ", ", lex.order = TRUE) else
    factor(rep("all trials", nrow(trials)))
  y <- tapply(trials$value, list(factor(trials$person, unique(trials$person)), cell), mean)
  left_out <- rownames(y)[!complete.cases(y)]
  if (length(left_out)) cat("left out:", paste(left_out, collapse = ", "), "\n")
  y <- y[complete.cases(y), , drop = FALSE]
  who <- droplevels(trials[match(rownames(y), trials$person), c("person", groups), drop = FALSE])
  many <- all(sapply(levels_of, length) > 1)
  if (nrow(y) > 1 && many) test_anova(m, y, who)
  if (nrow(y) > 1 && length(groups)) test_groups(m, y, who)
  if (has("lme4") && has("lmerTest")) {
    if (many) fit_effects(m, trials, factors)
  }
  if (nrow(y) > 1 && ncol(y) > 1) {
    test <- friedman.test(y)
    add(m, "Friedman", "condition", value = test$statistic, df_1 = test$parameter, p = test$p.value,
        effect_size = unname(test$statistic) / (nrow(y) * (ncol(y) - 1)))
    test_pairs(m, y)
  }
  for (f in quantities) fit_line(m, trials, f)
}
if (file.exists("openings.csv")) 
  test_openings(read_table("openings.csv", c("person", "trial", factors, "opening")))

rows <- do.call(rbind, rows); rownames(rows) <- NULL
write.csv(rows, "r_statistics.csv", row.names = FALSE, na = "")
print(rows[, c("measure", "analysis", "effect", "estimate", "value", "df_1", "df_2", "p")])
if (!is.null(stored)) {
  numbers <- c("estimate", "standard_error", "low", "high", "value", "df_1", "df_2", "p", "p_holm",
               "effect_size")
  key <- function(t) paste(t$measure, t$analysis, t$effect, sep = "\r")
  stored <- stored[rowSums(!is.na(stored[numbers])) > 0, ]
  at <- match(key(stored), key(rows)); worst <- rep(NA_real_, nrow(stored))
  for (i in which(!is.na(at))) {
    a <- unlist(stored[i, numbers]); b <- unlist(rows[at[i], numbers])
    drawn <- grepl("bootstrap", stored$analysis[i])
    # Of draws: a share of the interval's length. Else relative, small p values as good as equal.
    scale <- if (drawn) rep(abs(a["high"] - a["low"]), length(a)) else pmax(abs(a), abs(b), 1e-10)
    gap <- abs(a - b) / scale
    gap[is.na(a) & is.na(b)] <- 0; gap[is.na(a) != is.na(b)] <- Inf
    worst[i] <- max(gap)
  }
  limit <- ifelse(grepl("bootstrap", stored$analysis), 0.1,
                  ifelse(grepl("mixed model", stored$analysis), 1e-3, 1e-6))
  cat("\n==== against statistics.csv ====\n")
  for (analysis in unique(stored$analysis)) {
    own <- stored$analysis == analysis
    most <- if (all(is.na(worst[own]))) NA else max(worst[own], na.rm = TRUE)
    cat(format(analysis, width = 50), " ", sum(own), " rows, ", sum(own & !is.na(at)),
        " repeated, worst difference ", format(most, digits = 2),
        if (any(worst[own] > limit[own], na.rm = TRUE)) " DIFFERS", "\n", sep = "")
  }
  cat(sum(!is.na(worst) & worst <= limit), "of", nrow(stored), "rows agree,",
      sum(!is.na(worst) & worst > limit), "differ,", sum(is.na(at)), "are not repeated here\n")
  if (any(is.na(at)))
    cat("not repeated:", paste(unique(stored$analysis[is.na(at)]), collapse = "; "), "\n")
}
