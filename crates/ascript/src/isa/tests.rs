use super::*;
use crate::dialect::{COMMANDER, PERFORMAX_2};

const DIALECTS: [&Dialect; 2] = [&PERFORMAX_2, &COMMANDER];

#[test]
fn numbers() {
    for entry in TABLE {
        assert_eq!(entry.word.entry(), entry);
        assert_eq!(Word::from_number(entry.word as u8), Some(entry.word));
        assert!(entry.performax.is_some() || entry.commander.is_some(), "{} is in no dialect", entry.name);
    }
    assert_eq!([0, 14, 255].map(Word::from_number), [None; 3]);
}

#[test]
fn text_for_people() {
    for entry in TABLE {
        let doc = entry.doc;
        assert!(doc.summary.ends_with('.') && !doc.example.is_empty() && !doc.test.is_empty(), "{entry:?}");
        assert_eq!(entry.performax.is_some(), !doc.performax_section.is_empty(), "{}", entry.name);
        assert_eq!(entry.commander.is_some(), !doc.commander_section.is_empty(), "{}", entry.name);
    }
}

/// Every place that a dialect has.
fn places(dialect: &Dialect) -> impl Iterator<Item = Place> {
    let all = TABLE.iter().flat_map(|entry| (0..=u8::MAX).map(|index| Place::new(entry.word, index)));
    all.filter(|place| place.exists(dialect))
}

#[test]
fn every_place_has_a_name_of_its_own() {
    for dialect in DIALECTS {
        let mut names: Vec<String> = places(dialect).map(|place| place.to_string()).collect();
        names.sort();
        let twice = names.windows(2).find(|pair| pair[0] == pair[1]);
        assert_eq!(twice, None);
    }
}

#[test]
fn places_are_found_by_their_letters() {
    for dialect in DIALECTS {
        for place in places(dialect).filter(|place| place.word != Word::Linear) {
            let name = place.to_string();
            let suffix = place.word.entry().suffix;
            let letters = name.trim_end_matches(|c: char| !c.is_ascii_uppercase() && c != ';');
            let expected = match suffix {
                Suffix::Index(_) => Place { index: 0, ..place },
                Suffix::Direction | Suffix::Home => {
                    Place::directed(place.word, place.axis().expect("one"), Direction::Plus)
                }
                _ => place,
            };
            let numbered = matches!(suffix, Suffix::Index(_));
            assert_eq!(Place::from_letters(letters, numbered, dialect), Some(expected), "{name}");
        }
    }
}

#[test]
fn names() {
    let check = |dialect, letters, numbered, expected: Option<&str>| {
        let found = Place::from_letters(letters, numbered, dialect).map(|place| place.to_string());
        assert_eq!(found.as_deref(), expected, "{letters}");
    };
    check(&PERFORMAX_2, "HSPD", false, Some("HSPD"));
    check(&PERFORMAX_2, "HSPDY", false, Some("HSPDY"));
    check(&PERFORMAX_2, "HSPDZ", false, None);
    check(&COMMANDER, "HSPDZ", false, Some("HSPDZ"));
    check(&PERFORMAX_2, "HSPD", true, None);
    check(&PERFORMAX_2, "DO", true, Some("DO0"));
    check(&PERFORMAX_2, "DO", false, Some("DO"));
    check(&PERFORMAX_2, "ZOMEX", false, Some("ZOMEX+"));
    check(&COMMANDER, "ZOMEX", false, None);
    check(&PERFORMAX_2, "Z", false, None);
    check(&COMMANDER, "Z", false, Some("Z"));
    check(&COMMANDER, "CIRYXN", false, Some("CIRYXN"));
    check(&COMMANDER, "CIRXXN", false, None);
    check(&COMMANDER, "CIRXYQ", false, None);
    check(&COMMANDER, "CIRTP", false, Some("CIRTP"));
    check(&COMMANDER, "ARCT", false, None);
    check(&PERFORMAX_2, "hspd", false, None);
    check(&PERFORMAX_2, "", false, None);
}

#[test]
fn forms() {
    let check = |dialect: &Dialect, expected: &[&str]| {
        let forms: Vec<String> = words(dialect.family).map(|entry| entry.form(dialect)).collect();
        for form in expected {
            assert!(forms.iter().any(|other| other == form), "{form}");
        }
        let mut unique = forms.clone();
        unique.sort();
        unique.dedup();
        assert_eq!(unique.len(), forms.len(), "two words of one form");
    };
    // The rows of table 10.0, taken apart where one has several words.
    let performax = "; ABORT ABORT[axis] ABS ACC ACC[axis] AI[1-2] DEC DEC[axis] DELAY DI DI[1-8] DO DO[1-8] \
        ECLEAR[axis] EO EO[1-2] E[axis] GOSUB[0-31] HLHOME[axis][+/-] HOME[axis][+/-] HSPD HSPD[axis] IF ELSEIF \
        ELSE ENDIF INC JOG[axis][+/-] JOYENA JOYHS[axis] JOYDEL[axis] LHOME[axis][+/-] LSPD LSPD[axis] MST[axis] \
        PRG[0-1] END PS[axis] P[axis] SCV[axis] SLS[axis] SL[axis] SR[0-1] SSPDM[axis] SSPD[axis] STOP STOP[axis] \
        STORE SUB[0-31] ENDSUB TOC V[0-63] WAIT[axis] WHILE ENDWHILE X[position] X[pos]Y[pos] Y[position] \
        ZHOME[axis][+/-] ZOME[axis][+/-] JOYTOL[axis] JOYNO[axis] JOYNI[axis] JOYPI[axis] JOYPO[axis]";
    let performax: Vec<&str> = performax.split_whitespace().collect();
    check(&PERFORMAX_2, &performax);
    assert_eq!(words(Family::Performax).count(), performax.len());
    let commander = "; ABORT ABORT[axis] ABS ACC ACC[axis] AI[1-2] ARC[A1][A2][P/N][1]:[2]:[3] \
        ARCT[P/N][1]:[2]:[3]:[4] BUFOFF BUFON CIR[A1][A2][P/N][1]:[2] CIRT[P/N][1]:[2]:[3] DEC DEC[axis] DELAY DI \
        DI[1-4] DO DO[1-4] E[axis] ECLEAR[axis] EINT EO EO[1-4] GOSUB[0-31] HOME[axis][+/-][mode] HSPD HSPD[axis] \
        IF ELSEIF ELSE ENDIF INC IO IO[1-32] ISTART JOG[axis][+/-] JOYDEL[axis] JOYENA JOYHS[axis] LSPD \
        LSPD[axis] MST[axis] P[axis] PRG[0-3] END PS[axis] SL[axis] SLS[axis] SR[0-3] SSPD[axis] SSPDM[axis] STOP \
        STOP[axis] STORE SUB[0-31] ENDSUB SYNCFG[axis] SYNOFF[axis] SYNON[axis] SYNPOS[axis] SYNSTAT[axis] V[0-99] \
        WAIT[axis] WHILE ENDWHILE X[position] Y[position] Z[position] U[position] X[pos]Y[pos]Z[pos]U[pos] \
        ZMOVE[axis][+/-] LT[axis] LTE[axis] LTP[axis] LTS[axis] MPGE[axis] PWM[1-2]";
    let commander: Vec<&str> = commander.split_whitespace().collect();
    check(&COMMANDER, &commander);
    assert_eq!(words(Family::Commander).count(), commander.len());
}
