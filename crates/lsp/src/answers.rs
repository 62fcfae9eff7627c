//! What is known of a program, in the types and units of its editor.

use crate::{
    document::Document,
    layout,
    program::{Finding, Fold, Name, Part, Program, Proposal, Token, TokenKind, name_at},
    protocol::{
        ActiveParameter, Code, CompletionItem, CompletionItemKind, CompletionItemTextEdit, CompletionList,
        CompletionResponse, Contents, Definition, DefinitionResponse, Diagnostic, DiagnosticSeverity,
        DocumentHighlight, DocumentHighlightKind, DocumentSymbol, DocumentSymbolResponse, Documentation,
        FoldingRange, FoldingRangeKind, Hover, InsertTextFormat, Location, Message, ParameterInformation,
        ParameterInformationLabel, PrepareRenamePlaceholder, PrepareRenameResult, Range, SemanticToken,
        SemanticTokenModifiers, SemanticTokenTypes, SemanticTokens, SemanticTokensLegend, SignatureHelp,
        SignatureInformation, SymbolKind, TextEdit, Uri, WorkspaceEdit, markdown,
    },
    text::Encoding,
};
use source::{Source, Span};
use std::collections::HashMap;

/// What editors call the kinds of pieces, in the order of [`TokenKind`]: in colours, and in lists of proposals.
const KINDS: [(TokenKind, SemanticTokenTypes, CompletionItemKind); 12] = [
    (TokenKind::Comment, SemanticTokenTypes::Comment, CompletionItemKind::Text),
    (TokenKind::Keyword, SemanticTokenTypes::Keyword, CompletionItemKind::Keyword),
    (TokenKind::Action, SemanticTokenTypes::Method, CompletionItemKind::Method),
    (TokenKind::Label, SemanticTokenTypes::Function, CompletionItemKind::Function),
    (TokenKind::Constant, SemanticTokenTypes::Variable, CompletionItemKind::Constant),
    (TokenKind::Variable, SemanticTokenTypes::Variable, CompletionItemKind::Variable),
    (TokenKind::Parameter, SemanticTokenTypes::Property, CompletionItemKind::Property),
    (TokenKind::Option, SemanticTokenTypes::EnumMember, CompletionItemKind::EnumMember),
    (TokenKind::Number, SemanticTokenTypes::Number, CompletionItemKind::Value),
    (TokenKind::Operator, SemanticTokenTypes::Operator, CompletionItemKind::Operator),
    (TokenKind::Directive, SemanticTokenTypes::Macro, CompletionItemKind::Keyword),
    (TokenKind::File, SemanticTokenTypes::String, CompletionItemKind::File),
];

/// What else there is to a piece, a bit each.
const MODIFIERS: [SemanticTokenModifiers; 2] =
    [SemanticTokenModifiers::Definition, SemanticTokenModifiers::Readonly];
const DEFINITION: u32 = 1;
const READONLY: u32 = 2;

/// What the numbers of kinds and modifiers stand for.
pub(crate) fn legend() -> SemanticTokensLegend {
    SemanticTokensLegend {
        token_types: KINDS.map(|(_, kind, _)| kind.into()).into(),
        token_modifiers: MODIFIERS.map(Into::into).into(),
    }
}

/// A document that is asked about.
#[derive(Clone, Copy)]
pub(crate) struct Asked<'a> {
    pub(crate) document: &'a Document,
    pub(crate) encoding: Encoding,
    /// Whether the editor knows texts with places to be filled in.
    pub(crate) snippets: bool,
}

impl<'a> Asked<'a> {
    fn program(&self) -> &'a dyn Program {
        &*self.document.program
    }

    fn source(&self) -> &'a Source {
        &self.document.source
    }

    fn range(&self, span: &Span) -> Range {
        self.encoding.range(self.source(), span)
    }

    pub(crate) fn diagnostics(&self) -> Vec<Diagnostic> {
        self.program().findings().into_iter().map(|finding| self.diagnostic(finding)).collect()
    }

    fn diagnostic(&self, finding: Finding) -> Diagnostic {
        let severity = if finding.is_error { DiagnosticSeverity::Error } else { DiagnosticSeverity::Warning };
        Diagnostic {
            range: self.range(&finding.span),
            severity: Some(severity),
            code: finding.code.map(Code::String),
            source: Some("pulsetrain".into()),
            message: Message::String(finding.message),
            ..Diagnostic::default()
        }
    }

    pub(crate) fn tokens(&self) -> SemanticTokens {
        let mut data = Vec::new();
        let source = self.source();
        // Where the piece before began.
        let (mut line, mut byte) = (1, 0);
        for Token { span, kind, defines } in self.program().tokens() {
            let own_line = source.line(span.start);
            let delta_line = (own_line - line) as u32;
            if delta_line > 0 {
                (line, byte) = (own_line, source.line_span(own_line).start);
            }
            let delta_start = self.encoding.count(source.slice(&(byte..span.start)));
            byte = span.start;
            let readonly = if kind == TokenKind::Constant { READONLY } else { 0 };
            data.push(SemanticToken {
                delta_line,
                delta_start,
                length: self.encoding.count(source.slice(&span)),
                token_type: kind as u32,
                token_modifiers_bitset: readonly | if defines { DEFINITION } else { 0 },
            });
        }
        SemanticTokens { result_id: None, data }
    }

    pub(crate) fn hover(&self, at: usize) -> Option<Hover> {
        let (span, text) = self.program().hover(at)?;
        Some(Hover { contents: Contents::MarkupContent(markdown(text)), range: Some(self.range(&span)) })
    }

    pub(crate) fn signature(&self, at: usize) -> Option<SignatureHelp> {
        let signature = self.program().signature(at)?;
        let parameter = |(span, text): (Span, String)| {
            let until = |end| self.encoding.count(&signature.form[..end]);
            ParameterInformation {
                label: ParameterInformationLabel::Tuple((until(span.start), until(span.end))),
                documentation: (!text.is_empty()).then_some(Documentation::String(text)),
            }
        };
        let parameters: Vec<_> = signature.parameters.into_iter().map(parameter).collect();
        let active = ActiveParameter::Int(signature.active as u32);
        let information = SignatureInformation {
            label: signature.form,
            documentation: Some(Documentation::String(signature.text)),
            parameters: Some(parameters),
            active_parameter: None,
        };
        Some(SignatureHelp {
            signatures: vec![information],
            active_signature: Some(0),
            active_parameter: Some(active),
        })
    }

    pub(crate) fn completion(&self, at: usize) -> CompletionResponse {
        let (typed, proposals) = self.program().proposals(at);
        let range = self.range(&typed);
        let items = proposals.into_iter().map(|proposal| self.item(proposal, range)).collect();
        CompletionResponse::CompletionList(CompletionList { items, ..CompletionList::default() })
    }

    fn item(&self, proposal: Proposal, range: Range) -> CompletionItem {
        let snippet = proposal.snippet.filter(|_| self.snippets);
        let format = if snippet.is_some() { InsertTextFormat::Snippet } else { InsertTextFormat::PlainText };
        let new_text = snippet.or(proposal.insert).unwrap_or_else(|| proposal.label.clone());
        CompletionItem {
            label: proposal.label,
            kind: Some(KINDS[proposal.kind as usize].2),
            detail: Some(proposal.detail).filter(|detail| !detail.is_empty()),
            documentation: (!proposal.text.is_empty())
                .then(|| Documentation::MarkupContent(markdown(proposal.text))),
            filter_text: proposal.filter,
            insert_text_format: Some(format),
            text_edit: Some(CompletionItemTextEdit::TextEdit(TextEdit { range, new_text })),
            ..CompletionItem::default()
        }
    }

    /// The places of the name that stands at a place.
    fn names(&self, at: usize) -> Option<impl Iterator<Item = &'a Name>> {
        let names = self.program().names();
        let here = name_at(names, at)?;
        Some(names.iter().filter(|name| name.key == here.key))
    }

    /// Where a name is; `None` if that is in no file.
    fn location(&self, name: &Name) -> Option<Location> {
        if name.file == 0 {
            let uri = Uri(self.document.uri.clone());
            return Some(Location { uri, range: self.range(&name.span) });
        }
        let file = self.program().file(name.file)?;
        Some(Location { uri: Uri(file.name.clone()), range: self.encoding.range(file, &name.span) })
    }

    pub(crate) fn definition(&self, at: usize) -> Option<DefinitionResponse> {
        let places = self.names(at)?.filter(|name| name.defines);
        let places = places.filter_map(|name| self.location(name)).collect();
        Some(DefinitionResponse::Definition(Definition::LocationList(places)))
    }

    pub(crate) fn references(&self, at: usize, with_definition: bool) -> Option<Vec<Location>> {
        let places = self.names(at)?.filter(|name| with_definition || !name.defines);
        Some(places.filter_map(|name| self.location(name)).collect())
    }

    pub(crate) fn highlights(&self, at: usize) -> Option<Vec<DocumentHighlight>> {
        let highlight = |name: &Name| DocumentHighlight {
            range: self.range(&name.span),
            kind: Some(if name.defines { DocumentHighlightKind::Write } else { DocumentHighlightKind::Read }),
        };
        Some(self.names(at)?.filter(|name| name.file == 0).map(highlight).collect())
    }

    pub(crate) fn prepare_rename(&self, at: usize) -> Option<PrepareRenameResult> {
        let name = name_at(self.program().names(), at)?;
        // What cannot keep its name cannot have another one.
        self.program().renamed(name, &name.key).ok()?;
        Some(PrepareRenameResult::PrepareRenamePlaceholder(PrepareRenamePlaceholder {
            range: self.range(&name.span),
            placeholder: self.source().slice(&name.span).to_owned(),
        }))
    }

    /// The changes that give a name another one, or why there are none.
    pub(crate) fn rename(&self, at: usize, to: &str) -> Result<WorkspaceEdit, String> {
        let name = name_at(self.program().names(), at).ok_or("nothing here has a name")?;
        let new_text = self.program().renamed(name, to)?;
        let mut changes: HashMap<Uri, Vec<TextEdit>> = HashMap::new();
        for location in self.names(at).into_iter().flatten().filter_map(|name| self.location(name)) {
            let edit = TextEdit { range: location.range, new_text: new_text.clone() };
            changes.entry(location.uri).or_default().push(edit);
        }
        Ok(WorkspaceEdit { changes: Some(changes), ..WorkspaceEdit::default() })
    }

    pub(crate) fn symbols(&self) -> DocumentSymbolResponse {
        let parts = self.program().outline().into_iter();
        let symbol = |part: Part| {
            let detail = Some(part.detail).filter(|detail| !detail.is_empty());
            let kind = if part.is_code { SymbolKind::Function } else { SymbolKind::Constant };
            let (range, name) = (self.range(&part.span), self.range(&part.name_span));
            DocumentSymbol::new(part.name, detail, kind, None, None, range, name, None)
        };
        DocumentSymbolResponse::DocumentSymbolList(parts.map(symbol).collect())
    }

    pub(crate) fn folds(&self) -> Vec<FoldingRange> {
        let folds = self.program().folds().into_iter();
        let range = |fold: Fold| FoldingRange {
            start_line: fold.first as u32 - 1,
            end_line: fold.last as u32 - 1,
            kind: fold.is_comment.then_some(FoldingRangeKind::Comment),
            ..FoldingRange::default()
        };
        folds.map(range).collect()
    }

    pub(crate) fn formatting(&self) -> Option<Vec<TextEdit>> {
        let formatted = self.program().formatted()?;
        let edits = layout::edits(self.source(), &formatted).into_iter();
        Some(edits.map(|(span, new_text)| TextEdit { range: self.range(&span), new_text }).collect())
    }
}
